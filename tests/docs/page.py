# SPDX-License-Identifier: BSD-3-Clause
"""The code blocks of a page: ```LANGUAGE, then words: file=NAME, or why the block is none to check."""

import re
from typing import NamedTuple

FENCE = re.compile(r"^```([^\n]*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


class Block(NamedTuple):
    line: int  # of the fence
    language: str  # "" where none stands
    file: str  # "" where it is no whole file
    fragment: str  # why it cannot be checked; "" otherwise
    content: str


def blocks(text):
    out = []
    for m in FENCE.finditer(text):
        language, _, rest = m[1].partition(" ")
        name = re.match(r"file=(\S+)", rest)
        why = re.match(r"fragment: *(.*)", rest)
        if rest and not name and not why:
            raise ValueError(f"```{m[1]}: expected file=NAME or fragment: WHY behind the language")
        out.append(Block(text.count("\n", 0, m.start()) + 1, language, name[1] if name else "",
                         why[1] if why else "", m[2]))
    return out


def files(text):
    return {b.file: b.content for b in blocks(text) if b.file}


def commands(text):
    return "".join(b.content for b in blocks(text) if b.language == "sh")
