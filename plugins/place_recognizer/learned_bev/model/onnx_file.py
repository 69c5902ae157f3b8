# SPDX-License-Identifier: BSD-3-Clause
"""Writes small networks as ONNX files without the package onnx: a few messages of onnx.proto3 in the
wire format of protocol buffers (field numbers from onnx/onnx.proto3, opset 9)."""

import struct

FLOAT = 1


def varint(n):
    out = b""
    while n > 0x7F:
        out += bytes([n & 0x7F | 0x80])
        n >>= 7
    return out + bytes([n])


def field(number, value):
    """A field: whole numbers as varints, floats as 32 bits, texts and messages with their length."""
    if isinstance(value, int):
        return varint(number << 3) + varint(value)
    if isinstance(value, float):
        return varint(number << 3 | 5) + struct.pack("<f", value)
    data = value.encode() if isinstance(value, str) else value
    return varint(number << 3 | 2) + varint(len(data)) + data


def attribute(name, value):
    if isinstance(value, list):
        return field(1, name) + b"".join(field(8, v) for v in value) + field(20, 7)
    if isinstance(value, float):
        return field(1, name) + field(2, value) + field(20, 1)
    return field(1, name) + field(3, value) + field(20, 2)


def node(op, inputs, output, **attributes):
    return (b"".join(field(1, i) for i in inputs) + field(2, output) + field(3, output)
            + field(4, op) + b"".join(field(5, attribute(k, v)) for k, v in attributes.items()))


def tensor(name, array):
    array = array.astype("<f4")
    return (b"".join(field(1, d) for d in array.shape) + field(2, FLOAT) + field(8, name)
            + field(9, array.tobytes()))


def value_info(name, shape):
    dims = b"".join(field(1, field(1, d)) for d in shape)
    return field(1, name) + field(2, field(1, field(1, FLOAT) + field(2, dims)))


def model(nodes, tensors, inputs, outputs, producer):
    """The bytes of a file; inputs and outputs are (name, shape)."""
    graph = b"".join(field(1, n) for n in nodes) + field(2, "network")
    graph += b"".join(field(5, tensor(name, array)) for name, array in tensors.items())
    graph += b"".join(field(11, value_info(*i)) for i in inputs)
    graph += b"".join(field(12, value_info(*o)) for o in outputs)
    return (field(1, 4) + field(2, producer) + field(7, graph)
            + field(8, field(1, "") + field(2, 9)))
