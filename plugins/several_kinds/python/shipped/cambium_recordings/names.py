# SPDX-License-Identifier: BSD-3-Clause
"""Names of missions as ROS allows them in topics: letters, digits and _, a letter first."""

import re


def topic_names(names):
    """One for each, all different, in the same order."""
    out = []
    for name in names:
        word = re.sub(r"[^A-Za-z0-9_]", "_", name)
        word = word if re.match(r"[A-Za-z]", word) else "m" + word
        number, free = 2, word
        while free in out:
            free, number = f"{word}_{number}", number + 1
        out.append(free)
    return out


def map_frame(island):
    """The first island's map is `map`; the others are tied to it by nothing."""
    return "map" if island == 0 else f"map_{island + 1}"
