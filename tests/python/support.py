# SPDX-License-Identifier: Apache-2.0
"""What the tests of the Python package share: the package, the program and the library that they are told of.

Every test file is called with PROGRAM LIBRARY.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import warnings

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PACKAGE = SOURCE / "offline/python"
os.environ["PLUMB"], os.environ["PLUMB_LIBRARY"] = (os.path.abspath(word) for word in sys.argv[1:3])
sys.path[:0] = [str(PACKAGE), str(SOURCE / "tests/pages")]
try:
    import numpy as np
except ModuleNotFoundError:
    sys.exit("error: the Python module numpy is missing\n  = help: scripts/install-deps")
import plumb


def printed(*words):
    """The JSON object that the program prints; so the tests run it without the package."""
    done = subprocess.run([os.environ["PLUMB"], *map(str, words), "--json"], capture_output=True, check=False)
    return json.loads(done.stdout)


class Case(unittest.TestCase):
    """A folder of its own for every test, and no warnings of plumb on the screen."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        caught = warnings.catch_warnings()
        caught.__enter__()
        self.addCleanup(caught.__exit__, None, None, None)
        warnings.simplefilter("ignore", plumb.PlumbWarning)

    def demo(self, name):
        plumb.Program().demo(name, self.folder / name)
        return plumb.Cell(self.folder / name)


def demos():
    return [one["name"] for one in printed("demo", "--list")["result"]["demos"]]


def main():
    unittest.main(argv=sys.argv[:1])
