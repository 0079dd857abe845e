#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Building the library drivers/program builds only itself and model_format.

    program_test.py NINJA BUILD_FOLDER LIBRARY SOURCE_FOLDER
"""
import os
import re
import subprocess
import sys

ALLOWED = ("drivers/program/", "model_format/")


def sources(ninja, build, library, top):
    """Every source file of ours that ninja compiles on the way to the library, from the top. Of what the build wrote, a
    file of a unity build stands for those it includes, and the empty one of a precompiled header for none."""
    target = os.path.relpath(library, build)
    inputs = subprocess.run([ninja, "-C", build, "-t", "inputs", target], check=True, capture_output=True, text=True)
    here = [os.path.abspath(os.path.join(build, line.strip())) for line in inputs.stdout.splitlines()]
    written = os.path.abspath(build) + os.sep
    ours = [path for path in here if not path.startswith(written)]
    for path in here:
        if path.startswith(written) and "/Unity/" in path and path.endswith(".cxx"):
            with open(path, encoding="utf-8") as unity:
                ours += re.findall(r'#include "(.+)"', unity.read())
    return [os.path.relpath(path, top) for path in ours if path.endswith((".cpp", ".fbs"))]


if __name__ == "__main__":
    found = sources(*sys.argv[1:5])
    if not any(path.startswith(ALLOWED[0]) for path in found):
        sys.exit("error: no source file of drivers/program is an input of its library")
    other = [path for path in found if not path.startswith(ALLOWED)]
    if other:
        sys.exit("error: drivers/program is built with " + ", ".join(other)
                 + "\n  = help: take what it links beyond model_format out of drivers/program/CMakeLists.txt")
