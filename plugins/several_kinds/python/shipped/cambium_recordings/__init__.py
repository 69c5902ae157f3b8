# SPDX-License-Identifier: BSD-3-Clause
"""Recordings of ROS 1 and ROS 2, read and written through the package rosbags. docs/recordings.md."""

import sys

from cambium import Error


def need_rosbags():
    """Raises Error(plugin) that says what to install where, unless rosbags can be imported."""
    try:
        import rosbags.highlevel  # noqa: F401
    except ImportError as e:
        own = sys.prefix != sys.base_prefix  # a virtual environment is active
        there = (f"{sys.executable} -m pip install rosbags" if own else
                 "/usr/bin/python3 -m venv --system-site-packages ~/cambium-python && "
                 "~/cambium-python/bin/pip install rosbags && . ~/cambium-python/bin/activate")
        raise Error(f"ROS recordings need the Python package rosbags, which {sys.executable} does not have ({e}); "
                    f"install it, then run again: {there}", "rosbags", 3) from None
