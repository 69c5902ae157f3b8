# SPDX-License-Identifier: BSD-3-Clause
"""The network: two circular convolutions along the sectors of a polar image, the mean and the
maximum over all sectors, one linear layer. A turn of the robot shifts the sectors, which the mean
and the maximum do not see. Forward, backward (for training) and as ONNX."""

import numpy as np
import onnx_file

RINGS, SECTORS = 32, 64
FIRST, SECOND, OUT = 32, 64, 64  # channels
WIDE, NARROW = 9, 5              # kernels along the sectors


def initial(seed):
    """Weights as He et al. 2015 draw them."""
    rng = np.random.default_rng(seed)

    def layer(*shape):
        return (rng.standard_normal(shape) * np.sqrt(2 / np.prod(shape[1:]))).astype(np.float32)

    return {"w1": layer(FIRST, RINGS, WIDE), "b1": np.zeros(FIRST, np.float32),
            "w2": layer(SECOND, FIRST, NARROW), "b2": np.zeros(SECOND, np.float32),
            "w3": layer(OUT, 2 * SECOND), "b3": np.zeros(OUT, np.float32)}


def columns(x, width):
    """(batch, channels, sectors) -> (batch, sectors, channels * width), circular."""
    shifted = [np.roll(x, width // 2 - k, axis=2) for k in range(width)]
    return np.stack(shifted, 3).transpose(0, 2, 1, 3).reshape(x.shape[0], x.shape[2], -1)


def back_columns(d, channels, width):
    d = d.reshape(d.shape[0], d.shape[1], channels, width).transpose(0, 2, 1, 3)
    return sum(np.roll(d[..., k], k - width // 2, axis=2) for k in range(width))


def forward(p, x):
    """(batch, rings, sectors) -> unit descriptors (batch, OUT), and what backward() needs."""
    c1 = columns(x, WIDE)
    h1 = np.maximum(c1 @ p["w1"].reshape(FIRST, -1).T + p["b1"], 0)
    c2 = columns(h1.transpose(0, 2, 1), NARROW)
    h2 = np.maximum(c2 @ p["w2"].reshape(SECOND, -1).T + p["b2"], 0)
    pooled = np.concatenate([h2.mean(1), h2.max(1)], 1)
    y = pooled @ p["w3"].T + p["b3"]
    norm = np.linalg.norm(y, axis=1, keepdims=True) + 1e-9
    return y / norm, (c1, h1, c2, h2, pooled, y, norm)


def backward(p, kept, d):
    """Gradients of all weights from the gradient of the descriptors."""
    c1, h1, c2, h2, pooled, y, norm = kept
    unit = y / norm
    dy = (d - unit * (d * unit).sum(1, keepdims=True)) / norm
    g = {"w3": dy.T @ pooled, "b3": dy.sum(0)}
    dp = dy @ p["w3"]
    dh2 = np.repeat(dp[:, None, :SECOND] / SECTORS, SECTORS, 1)
    top = h2.argmax(1)
    batch, channel = np.indices(top.shape)
    dh2[batch, top, channel] += dp[:, SECOND:]
    dh2 *= h2 > 0
    g["w2"] = np.einsum("bso,bsi->oi", dh2, c2, optimize=True).reshape(p["w2"].shape)
    g["b2"] = dh2.sum((0, 1))
    dh1 = back_columns(dh2 @ p["w2"].reshape(SECOND, -1), FIRST, NARROW).transpose(0, 2, 1)
    dh1 = dh1 * (h1 > 0)
    g["w1"] = np.einsum("bso,bsi->oi", dh1, c1, optimize=True).reshape(p["w1"].shape)
    g["b1"] = dh1.sum((0, 1))
    return g


def circular(name, out, width):
    """Nodes that put width // 2 columns of each end beside the other end."""
    half = width // 2
    return [onnx_file.node("Slice", [name], f"{out}_last", axes=[3], starts=[SECTORS - half],
                           ends=[SECTORS]),
            onnx_file.node("Slice", [name], f"{out}_first", axes=[3], starts=[0], ends=[half]),
            onnx_file.node("Concat", [f"{out}_last", name, f"{out}_first"], out, axis=3)]


def to_onnx(p):
    """image (1, 1, rings, sectors) -> descriptor (1, OUT), not normalised."""
    conv = dict(strides=[1, 1], pads=[0, 0, 0, 0], dilations=[1, 1], group=1)
    nodes = circular("image", "wide", WIDE) + [
        onnx_file.node("Conv", ["wide", "w1", "b1"], "conv1", kernel_shape=[RINGS, WIDE], **conv),
        onnx_file.node("Relu", ["conv1"], "relu1")] + circular("relu1", "narrow", NARROW) + [
        onnx_file.node("Conv", ["narrow", "w2", "b2"], "conv2", kernel_shape=[1, NARROW], **conv),
        onnx_file.node("Relu", ["conv2"], "relu2"),
        onnx_file.node("GlobalAveragePool", ["relu2"], "mean"),
        onnx_file.node("GlobalMaxPool", ["relu2"], "most"),
        onnx_file.node("Concat", ["mean", "most"], "pooled", axis=1),
        onnx_file.node("Flatten", ["pooled"], "flat", axis=1),
        onnx_file.node("Gemm", ["flat", "w3", "b3"], "descriptor", transB=1)]
    tensors = {"w1": p["w1"][:, None], "b1": p["b1"], "w2": p["w2"][:, :, None], "b2": p["b2"],
               "w3": p["w3"], "b3": p["b3"]}
    return onnx_file.model(nodes, tensors, [("image", [1, 1, RINGS, SECTORS])],
                           [("descriptor", [1, OUT])], "cambium")
