# SPDX-License-Identifier: BSD-3-Clause
"""Command lines of the pages: taken apart, and held against the programs themselves."""

import re
import shlex
import subprocess
from pathlib import Path

UNKNOWN = "--no-such-option"


def simple_commands(text):
    """The words of each simple command; comments, redirections and assignments aside."""
    out = []
    for line in text.replace("\\\n", " ").splitlines():
        lexer = shlex.shlex(line, posix=True, punctuation_chars="&;|<>")
        lexer.whitespace_split = True
        words, skip = [], False
        for word in [*lexer, ";"]:
            if set(word) <= set("&;|"):
                if words:
                    out.append(words)
                words = []
            elif set(word) <= set("<>"):
                skip = True
            elif skip:
                skip = False
            elif words or not re.match(r"\w+=", word):
                words.append(word)
    return out


def wrong(words, program, source):
    """What is wrong with a command, or nothing. Programs that are not Cambium's are taken for right."""
    name = words[0]
    if Path(name).name == "cambium":
        return wrong_call(words[1:], program) or wrong_files(words, source)
    if name == "./bootstrap":
        known = re.findall(r"^  (\w+)\)", (source / "bootstrap").read_text(), re.MULTILINE)
        return "" if words[1] in known else f"./bootstrap knows {known}"
    if name.startswith("build/bin/bench_"):
        benches = (source / "tests/bench/CMakeLists.txt").read_text()
        return "" if f"bench({name[len('build/bin/bench_'):]} " in benches else "there is no such bench"
    if name.startswith("build/bin/test_"):
        plugin = name[len("build/bin/test_"):]
        return "" if list(source.glob(f"plugins/*/{plugin}/test.cpp")) else "there is no such test"
    return wrong_files(words, source)


def wrong_call(arguments, program):
    """The parser's own answer: with one option too many it must complain of that one, and of nothing else. It
    never comes to running anything."""
    if arguments in (["--version"], ["--version", "--abi"]):
        return ""
    said = subprocess.run([program, *arguments, UNKNOWN], capture_output=True, text=True, timeout=20)
    if said.returncode and re.search(rf"not expected: {UNKNOWN}$", said.stderr + said.stdout, re.MULTILINE):
        return ""
    return (said.stderr + said.stdout).strip() or "the program took an option that does not exist"


def wrong_files(words, source):
    """Files of the tree that a command names are there."""
    own = re.compile(r"(?:pipelines|tests|plugins|docs|framework)/[\w./-]+\.\w+$")
    missing = [word for word in words if own.match(word) and not (source / word).exists()]
    return f"the tree has no {', '.join(missing)}" if missing else ""
