#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The glossary holds exactly the terms and status texts of `plumb explain`.

usage: glossary_test.py [PLUMB]     with the program, what it prints is compared as well
"""
import json
import re
import subprocess
import sys
import unittest

import glossary_page

PLUMB = sys.argv[1] if len(sys.argv) > 1 else None
TABLES = ("kTerms", "kStatus")


def named_on_the_page():
    rows = re.findall(r"(?m)^\| (.+?) \| .* \|$", glossary_page.PAGE.read_text())
    return [name for name in rows if name not in ("term", "status")]


class Glossary(unittest.TestCase):

    def test_the_page_is_what_the_script_writes(self):
        self.assertEqual(glossary_page.PAGE.read_text(), glossary_page.page(), "scripts/glossary-page")

    def test_every_word_has_one_explanation(self):
        names = [re.sub("[-_ ]", "", name).casefold() for table in TABLES for name, _ in glossary_page.entries(table)]
        self.assertGreater(len(names), 50)
        self.assertEqual(sorted({name for name in names if names.count(name) > 1}), [])

    def test_every_explanation_ends_as_a_sentence(self):
        for table in TABLES:
            for name, words in glossary_page.entries(table):
                self.assertRegex(words, r"\.$", name)

    @unittest.skipUnless(PLUMB, "no program given")
    def test_the_program_and_the_page_name_the_same_words(self):
        printed = subprocess.run([PLUMB, "explain", "--json"], check=True, capture_output=True, text=True).stdout
        listed = json.loads(printed)["result"]
        self.assertEqual(sorted(named_on_the_page()), sorted(listed["term"] + listed["status"]))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
