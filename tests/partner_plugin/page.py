# SPDX-License-Identifier: BSD-3-Clause
"""Reads docs/write-a-plugin.md: its files and its commands."""

import re


def blocks(text):
    """(language, file name or "", content) of each fenced block."""
    fence = re.compile(r"^```(\w+)(?: file=(\S+))?\n(.*?)^```$", re.MULTILINE | re.DOTALL)
    return [(m[1], m[2] or "", m[3]) for m in fence.finditer(text)]


def files(text):
    return {name: content for _, name, content in blocks(text) if name}


def commands(text):
    return "".join(content for language, _, content in blocks(text) if language == "sh")
