#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes docs/glossary.md from the terms and status texts of `plumb explain` (offline/catalogue/terms.cpp).

usage: scripts/glossary-page            writes the page
       scripts/glossary-page --check    ends with 1 if the page is not what plumb explain says
"""
import pathlib
import re
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[2]
TERMS = SOURCE / "offline/catalogue/terms.cpp"
PAGE = SOURCE / "docs/glossary.md"

BEGINNING = """# Glossary

The terms of robot calibration as the programs, the other pages and the code use them, one meaning each. `plumb explain WORD`
prints the same explanations; this page is written from them by `scripts/glossary-page`, and a test compares the two. The
physical effects are explained by `plumb explain EFFECT`, and how they are defined is in
[adding-an-effect.md](adding-an-effect.md).
"""
STATUS = """
## Status of a corrected or predicted target

Every target is answered with one of these texts. "Valid" means that the answer can be used.
"""


def entries(table):
    """The name and the explanation of each entry of one table in terms.cpp, in the order of the table."""
    body = re.search(rf"(?s)\b{table}\[\] = \{{\n(.*?)\n\}};", TERMS.read_text()).group(1)
    string = r'"(?:[^"\\]|\\.)*"'
    found = re.findall(rf"\{{({string}),\s*((?:{string}\s*)+)\}}", body)
    if len(found) != len(re.findall(r"(?m)^    \{", body)):
        raise ValueError(f"{TERMS.name}: not every entry of {table} could be read")
    return [(text(name), text(words)) for name, words in found]


def text(literal):
    """The text of C++ string literals that stand one after the other."""
    return re.sub(r"\\(.)", r"\1", "".join(re.findall(r'"((?:[^"\\]|\\.)*)"', literal)))


def table(rows, head):
    cells = (tuple(cell.replace("|", "\\|").replace("<", "&lt;").replace("*", "\\*") for cell in row) for row in rows)
    return "\n".join([f"| {head} | meaning |", "|---|---|", *(f"| {name} | {words} |" for name, words in cells)]) + "\n"


def page():
    terms = sorted(entries("kTerms"), key=lambda entry: (entry[0].casefold(), entry[0]))
    return BEGINNING + "\n" + table(terms, "term") + STATUS + "\n" + table(entries("kStatus"), "status")


def main():
    if sys.argv[1:] == ["--check"]:
        if PAGE.exists() and PAGE.read_text() == page():
            return 0
        print("error: docs/glossary.md is not what plumb explain says\n  = help: scripts/glossary-page", file=sys.stderr)
        return 1
    PAGE.write_text(page())
    return 0


if __name__ == "__main__":
    sys.exit(main())
