# SPDX-License-Identifier: BSD-3-Clause
"""How much of a file is there that was cut off: a full disk, an empty battery, a broken copy.

Such files are refused: what follows the cut is lost, and a tool of the format (rosbag reindex, mcap recover,
sqlite3 .dump) makes a whole file of the rest, which is then imported. Only lengths and counts are read here.
"""

import struct
from pathlib import Path


def what_is_whole(path):
    """Empty for a whole file, else what is left of it and what to do."""
    size = Path(path).stat().st_size
    if size == 0:
        return "the file is empty: 0 bytes"
    with open(path, "rb") as file:
        return {".bag": _bag, ".mcap": _mcap, ".db3": _sqlite}[Path(path).suffix](file, size, path)


def _cut(size, end, chunks, messages, repair):
    return (f"the recording is cut off: of its {size} bytes {end} are whole, with {messages} messages in {chunks} chunks, "
            f"and the index that should follow is missing; {repair} keeps those, then import its result")


def _bag(file, size, path):
    magic = b"#ROSBAG V2.0\n"
    if file.read(len(magic)) != magic:
        return ""  # another format; the reader says so
    end, chunks, messages, pending = len(magic), 0, 0, 0
    while end < size:
        record = _bag_record(file, size)
        if record is None:
            break
        op, fields = record
        end = file.tell()
        if op == 3 and struct.unpack("<Q", fields.get(b"index_pos", bytes(8)))[0] not in (0, size):
            index = struct.unpack("<Q", fields[b"index_pos"])[0]
            if index < size and _reaches_the_end(file, index, size):
                return ""
            file.seek(end)
        chunks += op == 5
        messages += struct.unpack("<I", fields[b"count"])[0] if op == 4 else 0
    return _cut(size, end, chunks, messages, f"'rosbag reindex {path}'")


def _bag_record(file, size):
    """(op, header fields) of the record here, past which the file then stands; None: it is not whole."""
    head = file.read(4)
    length = struct.unpack("<I", head)[0] if len(head) == 4 else size
    if length > size - file.tell():
        return None
    text, fields, at = file.read(length), {}, 0
    while at + 4 <= length:
        n = struct.unpack_from("<I", text, at)[0]
        name, _, value = text[at + 4:at + 4 + n].partition(b"=")
        fields[name] = value
        at += 4 + n
    data = file.read(4)
    if len(data) < 4 or b"op" not in fields or struct.unpack("<I", data)[0] > size - file.tell():
        return None
    file.seek(struct.unpack("<I", data)[0], 1)
    return fields[b"op"][0], fields


def _reaches_the_end(file, start, size):
    file.seek(start)
    while file.tell() < size:
        if _bag_record(file, size) is None:
            return False
    return True


def _mcap(file, size, path):
    magic = b"\x89MCAP0\r\n"
    if file.read(len(magic)) != magic:
        return ""
    file.seek(max(0, size - len(magic)))
    if file.read() == magic and size > 2 * len(magic):
        return ""
    end, chunks, messages = len(magic), 0, 0
    file.seek(end)
    while True:
        head = file.read(9)
        if len(head) < 9:
            break
        op, length = struct.unpack("<BQ", head)
        if length > size - file.tell():
            break
        if op == 7:  # message index: channel, bytes of 16 an entry
            messages += struct.unpack("<HI", file.read(6))[1] // 16
        chunks += op == 6
        end += 9 + length
        file.seek(end)
    return _cut(size, end, chunks, messages, f"'mcap recover {path} -o whole.mcap'")


def _sqlite(file, size, path):
    head = file.read(100)
    if len(head) < 100 or head[:16] != b"SQLite format 3\0":
        return ""
    page, pages = struct.unpack(">H", head[16:18])[0], struct.unpack(">I", head[28:32])[0]
    page = 65536 if page == 1 else page
    # The count of pages is right when both change counters agree; a journal beside it holds the rest.
    if head[24:28] != head[92:96] or Path(f"{path}-wal").exists() or size >= page * pages:
        return ""
    return (f"the recording is cut off: {size // page} of its {pages} pages are there; 'sqlite3 {path} .dump | sed "
            f"\"s/^ROLLBACK.*/COMMIT;/\" | sqlite3 whole.db3' keeps what they hold, then import its result")
