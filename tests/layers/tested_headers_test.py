#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every header of the rooms that judge is included by a test of its own, but for those in untested_headers.txt: a list
that may only shrink."""
import pathlib
import tempfile
import unittest

from layers_test import SOURCE, header_of, includes_of

ROOMS = ("offline/check", "offline/diagnose", "offline/recheck", "drivers/rt")
LIST = "tests/layers/untested_headers.txt"


def untested(source):
    """Headers of these rooms that no file below tests/ includes, in the order of their names."""
    headers = {path.relative_to(source) for room in ROOMS for path in (source / room).glob("*.hpp")}
    names, included = {header.name for header in headers}, set()
    for path in sorted((source / "tests").rglob("*.[ch]pp")):
        for _, quoted, name in includes_of(path):
            if quoted and pathlib.PurePath(name).name in names:
                included.add(header_of(source, path.relative_to(source), name))
    return sorted(path.as_posix() for path in headers - included)


class TestedHeaders(unittest.TestCase):

    def test_no_header_joins_those_that_no_test_includes(self):
        listed = (SOURCE / LIST).read_text().split()
        found = untested(SOURCE)
        self.assertEqual(sorted(set(found) - set(listed)), [],
                         "no test includes these headers: write laws for what they decide (tests/recheck shows how)")
        self.assertEqual(sorted(set(listed) - set(found)), [],
                         f"these are tested now, or gone: take them out of {LIST}")
        self.assertEqual(listed, found, f"{LIST} is in the order of the names, each once")


class Planted(unittest.TestCase):
    """The rule catches what it is for."""

    def test_a_header_counts_as_tested_once_a_test_includes_it(self):
        with tempfile.TemporaryDirectory() as folder:
            source = pathlib.Path(folder).resolve()
            for name, text in (("offline/check/one.hpp", ""), ("offline/check/two.hpp", '#include "check/one.hpp"\n'),
                               ("offline/fit/fit.hpp", ""), ("tests/check/one_test.cpp", "// check/one.hpp\n")):
                (source / name).parent.mkdir(parents=True, exist_ok=True)
                (source / name).write_text(text)
            self.assertEqual(untested(source), ["offline/check/one.hpp", "offline/check/two.hpp"])
            (source / "tests/check/one_test.cpp").write_text('#include "check/one.hpp"\n')
            self.assertEqual(untested(source), ["offline/check/two.hpp"])


if __name__ == "__main__":
    unittest.main()
