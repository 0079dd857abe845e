#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tables of the README and of the pages agree with the folders and with themselves."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

import page_types
import python_types

SOURCE = pathlib.Path(__file__).resolve().parents[2]
README = (SOURCE / "README.md").read_text()


def folders(where):
    """Folders that hold something of ours: builds, caches and hidden ones do not count."""
    return {path.name for path in where.iterdir()
            if path.is_dir() and not path.name.startswith((".", "build", "__")) and any(path.iterdir())}


def table(text, head):
    """The first cells of the table that begins with this head."""
    body = text.partition(f"| {head} |")[2].partition("\n\n")[0]
    return re.findall(r"(?m)^\| `([^`]+)/` \|", body)


class Readme(unittest.TestCase):

    def test_the_folder_table_is_complete(self):
        self.assertEqual(set(table(README, "folder")), folders(SOURCE))

    def test_it_is_short(self):
        self.assertLessEqual(len(README.splitlines()), 120)

    def test_every_page_is_linked(self):
        index = (SOURCE / "docs/README.md").read_text()
        for page in (SOURCE / "docs").glob("*.md"):
            if page.name != "README.md":
                self.assertIn(f"]({page.name})", index)

    def test_the_page_of_the_model_has_every_effect(self):
        laws = [*(SOURCE / "runtime/include/plumb/runtime/detail/effects").glob("*.hpp"),
                *(SOURCE / "offline/effects/measurement").glob("*.hpp")]
        self.assertGreater(len(laws), 20)
        page = (SOURCE / "docs/model.md").read_text()
        for law in laws:
            self.assertIn(f"`{law.stem}`", page)


def stages(script):
    """What a script of tests runs, in order: names of stages, and presets."""
    text = re.sub(r"(?s)\n\w+\(\) \{.*?\n\}\n", "\n", script.read_text().replace("\\\n", " "))
    some = {"-LE slow": ", fast tests", "-L slow": ", slow tests", "": ""}
    for line in text.splitlines():
        if named := re.match(r'(?:stage|tally) "([^"]+)"', line):
            yield named[1]
        elif preset := re.match(r'built_and_tested (\S+) "[^"]*" ?(.*)', line):
            yield f"preset {preset[1]}{some[preset[2].strip()]}"
        elif preset := re.match(r"tested (\S+) ", line):
            yield f"preset {preset[1]}, some tests"


def cannot_start(text):
    """Stages of a script whose command is no function of it or of lib.sh, no program of ours, and none installed."""
    functions = set(re.findall(r"(?m)^(\w+)\(\) ", text + (SOURCE / "scripts/lib.sh").read_text()))
    for name, command in re.findall(r'(?m)^\s*(?:stage|tally) "([^"]+)" (\S+)', text.replace("\\\n", " ")):
        ours = SOURCE / command
        if not (command in functions or shutil.which(command) if "/" not in command else os.access(ours, os.X_OK)):
            yield name


class Ci(unittest.TestCase):

    def test_every_stage_can_start(self):
        scripts = sorted((SOURCE / "scripts").glob("test*"))
        self.assertGreaterEqual(len(scripts), 4)
        for script in scripts:
            self.assertEqual(list(cannot_start(script.read_text())), [], script.name)
            subprocess.run(["bash", "-n", script], check=True)
        planted = 'tally "a" tests/twin/no_such\nstage "b" no_such_function\ntally "c" tests/twin/cli_test.cpp\nstage "d" stage x'
        self.assertEqual(list(cannot_start(planted)), ["a", "b", "c"])

    def test_the_page_names_what_the_scripts_run(self):
        page = (SOURCE / "docs/ci.md").read_text()
        for name in ("test", "test-gates", "test-nightly"):
            said = re.findall(r"(?m)^\* (.*)$", page.partition(f"## `scripts/{name}`\n")[2].partition("\n## ")[0])
            self.assertEqual(said, list(stages(SOURCE / "scripts" / name)), name)
            self.assertTrue(said, name)


class PageOfTheWorkbench(unittest.TestCase):
    def test_its_types_of_results_are_those_of_the_schemas(self):
        self.assertEqual(page_types.FILE.read_text(), page_types.page(), "write it anew: tests/pages/page_types.py")


class PythonPackage(unittest.TestCase):
    def test_its_results_and_verbs_are_those_of_the_schemas(self):
        for file, page in python_types.FILES.items():
            self.assertEqual(file.read_text(), page(), f"write {file.name} anew: tests/pages/python_types.py")


class Pages(unittest.TestCase):

    def test_every_link_leads_somewhere(self):
        for page in [SOURCE / "README.md", *(SOURCE / "docs").glob("*.md")]:
            words = re.sub(r"(?ms)^```.*?^```", "", page.read_text())  # code has no links
            for target in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", words):
                self.assertTrue((page.parent / target).exists(), f"{page.name}: {target}")


class HowFew(unittest.TestCase):
    def test_the_figure_is_that_of_the_tables(self):
        drawn = subprocess.run([SOURCE / "tests/pages/how_few_figure.py", "--print"], check=True, capture_output=True,
                               encoding="utf-8").stdout
        self.assertEqual(drawn, (SOURCE / "docs/screenshots/how-few.svg").read_text(encoding="utf-8"),
                         "draw it again: tests/pages/how_few_figure.py")
        self.assertEqual(drawn.count("<circle"), 28)


class AtNight(unittest.TestCase):
    """docs/operate.md has an answer to every alarm, every fault and every input that may be missing."""
    PAGE = (SOURCE / "docs/operate.md").read_text()

    def rows_of(self, heading):
        section = self.PAGE.partition(f"\n## {heading}\n")[2].partition("\n## ")[0]
        first = re.findall(r"(?m)^\| ([^|]+) \|", section)
        return {word for cell in first for word in re.findall(r"`?([\w-]+)`?", cell)}

    def test_of_every_alert(self):
        alerts = re.findall(r"alert: (\w+)", (SOURCE / "docs/examples/plumb-rt-alerts.yml").read_text())
        self.assertGreater(len(alerts), 5)
        self.assertLessEqual(set(alerts), self.rows_of("Alarms"))

    def test_of_every_fault_and_missing_input(self):
        status = json.loads((SOURCE / "docs/schemas/rt-status.json").read_text())
        words = status["properties"]["result"]["properties"]
        self.assertLessEqual(set(words["fault"]["enum"]) - {"none", "unknown"}, self.rows_of("Faults"))
        self.assertLessEqual(set(words["lost"]["items"]["enum"]), self.rows_of("Missing inputs"))


class Packages(unittest.TestCase):
    """What scripts/package needs and does not find it names, with what installs it, before it builds anything."""

    def test_without_lintian(self):
        help_line = "scripts/install-deps --package"
        with tempfile.TemporaryDirectory() as folder:
            for name in ("env", "bash", "dirname"):
                os.symlink(shutil.which(name), pathlib.Path(folder, name))
            for name in ("dpkg-architecture", "file"):
                os.symlink("/bin/true", pathlib.Path(folder, name))
            ran = subprocess.run([SOURCE / "scripts/package"], env={"PATH": folder}, capture_output=True, text=True, check=False)
        self.assertEqual((ran.returncode, ran.stderr), (5, f"error: lintian is not installed\nhelp: {help_line}\n"))
        self.assertIn(help_line, (SOURCE / "docs/install.md").read_text())


class BlindStudy(unittest.TestCase):
    """A value beyond its mark is never called passed. Where both print alike, the unrounded value has decided."""
    ROW = re.compile(r"(?m)^\| ([^|]+) \| ([\d.e-]+)[^|]*\| (?:median )?(<=|>=) ([\d.]+)[^|]*\| ([^|]+) \|$")

    def test_the_table_says_missed_where_a_mark_is_missed(self):
        of_page = {page: self.ROW.findall((SOURCE / "docs" / page).read_text())
                   for page in ("blind-study.md", "recheck-study.md", "fleet-study.md", "transfer-study.md")}
        self.assertGreater(len(of_page["blind-study.md"]), 20)
        self.assertGreater(len(of_page["recheck-study.md"]), 6)
        for what, found, sign, mark, result in sum(of_page.values(), []):
            kept = float(found) <= float(mark) if sign == "<=" else float(found) >= float(mark)
            missed = ("missed", "missed, within the allowance")
            words = ("passed", *missed) if float(found) == float(mark) else ("passed",) if kept else missed
            self.assertIn(result, words, what)


if __name__ == "__main__":
    unittest.main()
