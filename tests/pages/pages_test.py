#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The manual page and the shell completions of a program name every verb and every option that its help names, and the pages of docs every option.

usage: pages_test.py PROGRAM
"""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM = pathlib.Path(sys.argv[1]).resolve()
NAME = PROGRAM.name
SOURCE = pathlib.Path(__file__).resolve().parents[2]


def printed(*words):
    return subprocess.run([PROGRAM, *words], check=True, capture_output=True, text=True).stdout


def section(help_text, title):
    return help_text.partition(f"\n{title}:\n")[2].partition("\n\n")[0]


def heads(help_text):
    """The names of each option: ["-o", "--output"] of "  -o,--output FILE"."""
    return [head.split(",") for head in re.findall(r"(?m)^  (-\S+)", section(help_text, "Options"))]


def options(help_text):
    return {name for head in heads(help_text) for name in head}


HELP = printed("--help")
VERBS = re.findall(r"(?m)^  (\S+)  ", section(HELP, "Verbs"))
HELP_OF = {verb: printed(verb, "--help") for verb in VERBS}
OPTIONS = {verb: options(text) for verb, text in HELP_OF.items()}
MAN = printed("--man")
COMPLETIONS = {shell: printed("--completion", shell) for shell in ("bash", "zsh", "fish")}


def plain(roff):
    """The text of a manual page without fonts and escapes."""
    return re.sub(r"\\f[BIR]|\\&", "", roff).replace("\\-", "-").replace("\\e", "\\")


def part_of(verb):
    """What the manual page says of one verb."""
    return plain(MAN).partition(f'.SS "{NAME} {verb}"\n')[2].partition("\n.S")[0]


def names(words, name):
    return re.search(rf"(?<![\w-]){re.escape(name)}(?![\w-])", words) is not None


def complete(words):
    """What bash offers for the last of these words."""
    with tempfile.NamedTemporaryFile("w", suffix=".bash") as script:
        script.write(COMPLETIONS["bash"])
        script.flush()
        quoted = " ".join(f"'{word}'" for word in words)
        return subprocess.run(
            ["bash", "-c", f"source {script.name}; COMP_WORDS=({quoted}); COMP_CWORD={len(words) - 1}; "
             f"_{NAME.replace('-', '_')}; printf '%s\\n' \"${{COMPREPLY[@]}}\""],
            check=True, capture_output=True, text=True).stdout.split()


class Pages(unittest.TestCase):

    def test_the_help_names_verbs_and_options(self):
        self.assertGreaterEqual(len(VERBS), 3)
        self.assertLessEqual({"--version", "--json", "--man", "--completion"}, options(HELP))
        for verb in VERBS:
            self.assertLessEqual({"-h", "--help", "--json"}, OPTIONS[verb], verb)

    def test_the_manual_page_names_every_verb_with_every_option(self):
        of_all = plain(MAN).partition(".SH OPTIONS")[2].partition("\n.SH")[0]
        for option in options(HELP):
            self.assertTrue(names(of_all, option), option)
        for verb in VERBS:
            self.assertTrue(part_of(verb), f"no section of {verb}")
            for option in OPTIONS[verb]:
                self.assertTrue(names(part_of(verb), option) or names(of_all, option), f"{verb} {option}")

    def test_a_page_for_readers_names_every_option(self):
        pages = "\n".join(path.read_text() for path in [SOURCE / "README.md", *(SOURCE / "docs").rglob("*.md")])
        for verb, text in HELP_OF.items():
            for head in heads(text):
                self.assertTrue(head == ["-h", "--help"] or any(names(pages, name) for name in head), f"{NAME} {verb} {head}")

    def test_the_manual_page_has_the_sections_of_a_manual_page(self):
        titles = re.findall(r"(?m)^\.SH (.*)$", MAN)
        self.assertEqual(titles, ["NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "VERBS", "EXIT STATUS", "FILES",
                                  "SEE ALSO"])
        self.assertRegex(MAN, rf'(?m)^\.TH {plain(NAME.upper())} 1 "" "{plain(NAME)} '.replace("-", r"\\-"))
        self.assertRegex(plain(MAN), rf"(?m)^\.SH NAME\n{NAME} - [a-z].*[^.]$")

    def test_the_manual_page_is_sound_roff(self):
        requests = set(re.findall(r"(?m)^(\.\S*)", MAN))
        self.assertLessEqual(requests, {'.\\"', ".TH", ".SH", ".SS", ".TP", ".PP", ".B", ".nf", ".fi"})
        depth = 0
        for request in re.findall(r"(?m)^(\.nf|\.fi)$", MAN):
            depth += 1 if request == ".nf" else -1
            self.assertIn(depth, (0, 1))
        self.assertEqual(depth, 0)
        for number, line in enumerate(MAN.splitlines(), 1):
            self.assertNotEqual(line[:1], "'", f"line {number} would be a request")
            fonts = re.findall(r"\\f([BIR])", line)
            self.assertEqual(fonts[-1:] or ["R"], ["R"], f"line {number} does not return to the roman font")
        for line, item in zip(MAN.splitlines(), MAN.splitlines()[1:] + [""]):
            if line == ".TP":
                self.assertNotEqual(item, "", "an item without a name")

    def test_the_manual_page_names_the_exit_codes(self):
        codes = [int(code) for code in re.findall(r"(?m)^\.B (\d+)$", MAN)]
        self.assertEqual(codes, sorted(codes))
        self.assertLessEqual({0, 1, 2, 3, 4, 5, 70, 130}, set(codes))
        self.assertEqual(6 in codes, NAME != "plumb")

    def test_every_completion_names_every_verb_and_option(self):
        for shell, text in COMPLETIONS.items():
            for verb in VERBS:
                self.assertTrue(names(text, verb), f"{shell}: {verb}")
            for option in options(HELP).union(*OPTIONS.values()):
                # fish writes -l output for --output and -s o for -o.
                word = option
                if shell == "fish":
                    word = f"-l {option[2:]}" if option.startswith("--") else f"-s {option[1:]}"
                self.assertIn(word, text, f"{shell}: {option}")

    def test_bash_completes_verbs(self):
        self.assertEqual(sorted(complete([NAME, ""])), sorted(VERBS))
        for verb in VERBS:
            self.assertIn(verb, complete([NAME, verb[:2]]))
            self.assertTrue(all(word.startswith(verb[:2]) for word in complete([NAME, verb[:2]])))

    def test_bash_completes_exactly_the_options_of_each_verb(self):
        self.assertEqual(set(complete([NAME, "-"])), options(HELP))
        for verb in VERBS:
            self.assertEqual(set(complete([NAME, verb, "-"])), OPTIONS[verb], verb)

    def test_bash_completes_the_words_of_an_option(self):
        self.assertEqual(complete([NAME, "--completion", ""]), ["bash", "zsh", "fish"])
        self.assertEqual(complete([NAME, "--completion", "=", "z"]), ["zsh"])


@unittest.skipUnless(NAME == "plumb", "words of plumb")
class PagesOfPlumb(unittest.TestCase):

    def test_the_two_completions_that_everybody_types(self):
        self.assertEqual(sorted(complete(["plumb", "fi"])), ["filter", "fit"])
        self.assertEqual(sorted(complete(["plumb", "fit", "--he"])), ["--held-out", "--help"])

    def test_the_exit_codes_are_those_of_the_reference_page(self):
        page = (pathlib.Path(__file__).parents[2] / "docs/exit-codes.md").read_text()
        rows = re.findall(r"(?m)^\| (\d+) \| ([^|]+) \|", page)
        items = re.findall(r"(?m)^\.B (\d+)\n(.*)\.$", plain(MAN))
        self.assertEqual([(code, text.lower()) for code, text in items], [(code, text.lower()) for code, text in rows])

    def test_a_folder_is_not_taken_for_the_verb(self):
        self.assertEqual(complete(["plumb", "-C", "fit", "comp"]), ["compare", "compile"])
        self.assertEqual(complete(["plumb", "-C", "mycell", "fit", "--max"]), ["--max-rms"])

    def test_words_of_options_and_of_positional_words(self):
        self.assertEqual(complete(["plumb", "fit", "--base", ""]), ["arm", "controller"])
        self.assertEqual(complete(["plumb", "new", "--convention", "s"]), ["standard"])
        self.assertEqual(complete(["plumb", "study", ""]), ["planar", "six-axis"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
