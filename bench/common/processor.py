# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""What the benchmarks in Python say of the machine."""

import pathlib
import platform


def processor():
    """The processor's name, of whatever kind the system tells."""
    try:
        text = pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8")
    except OSError:
        return platform.machine()
    names = [line.partition(":")[2].strip() for line in text.splitlines()
             if line.startswith("model name")]
    return names[0] if names else platform.machine()
