#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Carries out the steps of docs/adding-an-effect.md as they are written there, in a copy of the sources, and compiles
and checks the law that comes of them.

usage: adding_an_effect.py COMPILER HEADERS LIBRARY...
HEADERS: folders of headers of other projects, separated by semicolons. LIBRARY: what the effects are linked with.
"""
import contextlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PAGE = (SOURCE / "docs/adding-an-effect.md").read_text()
NUMBERS = {"two": 2, "three": 3, "four": 4, "five": 5, "six": 6, "seven": 7, "eight": 8, "nine": 9, "ten": 10,
           "eleven": 11, "twelve": 12}
# All of the runtime that evaluates a model; its cycle, guard and corrector know no laws.
RUNTIME = ("chain", "effect_library", "effect_set", "elementary", "fallbacks", "forward_model", "crisp_trees", "loads",
           "status", "trained_domain", "transform", "tree")


class Step:
    """One block of code, and the last file that the text before it names."""

    def __init__(self, file, kind, code):
        self.file, self.is_new, self.code = file, kind == "cpp", code

    def changed(self, text):
        """A text after the edit: the lines marked with a blank or a minus stand in it once, together."""
        lines = self.code.splitlines(keepends=True)
        old = "".join(line[1:] for line in lines if line[0] in " -")
        new = "".join(line[1:] for line in lines if line[0] in " +")
        if text.count(old) != 1:
            raise AssertionError(f"docs/adding-an-effect.md: {self.file} has these lines {text.count(old)} times, not "
                                 f"once:\n{old}")
        return text.replace(old, new)

    def carry_out(self, tree):
        path = tree / self.file
        if self.is_new:
            if path.exists():
                raise AssertionError(f"docs/adding-an-effect.md: {self.file} is there already")
            path.write_text(self.code)
        else:
            path.write_text(self.changed(path.read_text()))


def steps_of(page):
    """The blocks of a page; each belongs to the last path in the paragraph before it."""
    out = []
    for words, kind, code in re.findall(r"(?ms)((?:^(?!```).*?\n)*?)^```(cpp|diff)\n(.*?)^```$", page):
        named = re.findall(r"`((?:runtime|offline|tests)/[\w/.-]+\.\w+)`", words.strip().rpartition("\n\n")[2])
        if not named:
            raise AssertionError(f"docs/adding-an-effect.md: no file is named before this block:\n{code}")
        out.append(Step(named[-1], kind, code))
    return out


STEPS = steps_of(PAGE)
LAW = re.search(r'\.name = "(\w+)"', STEPS[0].code)[1]


class Scratch:
    """A copy of the sources that the law concerns."""

    def __init__(self, folder):
        self.tree = pathlib.Path(folder)
        for part in ("runtime", "model_format", "offline", "tests/fit"):
            shutil.copytree(SOURCE / part, self.tree / part)

    def compile(self, output, *sources, only_read=False):
        """Several sources are compiled as one. Returns what the compiler says, or None if it has no objection."""
        unit = self.tree / f"{output}.cpp"
        unit.write_text("".join(f'#include "{self.tree / source}"\n' for source in sources))
        what = ["-fsyntax-only"] if only_read else ["-c", "-o", self.tree / f"{output}.o"]
        done = subprocess.run([COMPILER, "-std=c++20", "-O0", "-ffp-contract=off", "-Wall", "-Wextra", "-Werror",
                               *[f"-I{self.tree / part}" for part in
                                 ("runtime/include", "model_format/include", "offline")],
                               *[f"-I{SOURCE / part}" for part in ("drivers", "drivers/include", "")],
                               *[f"-isystem{folder}" for folder in HEADERS], *what, unit],
                              capture_output=True, text=True, env=os.environ | {"LC_ALL": "C"})
        return None if done.returncode == 0 else done.stderr

    def link_and_run(self, *objects):
        program = self.tree / "check"
        objects = [self.tree / f"{name}.o" for name in objects]
        subprocess.run([COMPILER, *objects, *LIBRARIES, "-o", program], check=True)
        return subprocess.run([program, LAW], capture_output=True, text=True)


def without_derivative(header):
    """A planted fault: the motion no longer depends on the parameter as far as its derivative goes."""
    include = '#include "plumb/runtime/detail/effect.hpp"\n'
    with_plain = header.replace(include, include + '#include "plumb/runtime/detail/plain.hpp"\n')
    return with_plain.replace("+= c[i] ", "+= plain(c[i]) ")


class Page(unittest.TestCase):

    def test_it_states_how_many_files_are_touched(self):
        files = {step.file: step.is_new for step in STEPS}
        stated = re.search(r"\*\*(\w+) files are touched\*\*: (\w+) make the law work \((\w+) new ones and (\w+) "
                           r"lines in (\w+) others\), (\w+) more [^(]*\(one new file and a few lines in (\w+) others\)",
                           " ".join(PAGE.split()))
        self.assertIsNotNone(stated, "the sentence that states it")
        evidence = {file for file in files if file.startswith(("offline/simulate/", "tests/"))}
        works = files.keys() - evidence
        added = [line for step in STEPS if step.file in works and not step.is_new
                 for line in step.code.splitlines() if line.startswith("+")]
        self.assertEqual([NUMBERS[word.lower()] for word in stated.groups()],
                         [len(files), len(works), sum(files[file] for file in works), len(added),
                          sum(not files[file] for file in works), len(evidence),
                          sum(not files[file] for file in evidence)])
        self.assertEqual(sum(files[file] for file in evidence), 1)

    def test_the_law_is_not_in_the_library(self):
        for step in STEPS:
            self.assertEqual((SOURCE / step.file).exists(), not step.is_new, step.file)

    def test_the_tour_states_how_many_effects_are_known(self):
        lists = {"runtime/include/plumb/runtime/detail/effect_library.hpp": "EffectLaws",
                 "offline/effects/fitted_laws.hpp": "MeasurementLaws"}
        laws = [law for file, name in lists.items()
                for law in re.findall(r"effects::\w+", re.search(rf"using {name} =(.*?);", (SOURCE / file).read_text(),
                                                                 re.DOTALL)[1])]
        self.assertEqual(re.search(r"(\d+) physical effects are known", (SOURCE / "docs/tour.md").read_text())[1],
                         str(len(laws)))

    def test_an_edit_whose_place_has_changed_is_refused(self):
        edit = Step("somewhere.hpp", "diff", " one\n+two\n")
        self.assertEqual(edit.changed("zero\none\n"), "zero\none\ntwo\n")
        for text in ("zero\n", "one\none\n"):
            with self.assertRaises(AssertionError):
                edit.changed(text)


class Law(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.scratch = Scratch(folder.name)
        for step in STEPS:
            step.carry_out(cls.scratch.tree)

    def compiles(self, output, *sources):
        objections = self.scratch.compile(output, *sources)
        self.assertIsNone(objections, objections)

    def checked(self):
        """What the check of the law says, with its header as it is now."""
        self.compiles("new_law_check", SOURCE / "tests/effects/new_law_check.cpp")
        return self.scratch.link_and_run("new_law_check", "effects", *RUNTIME)

    @contextlib.contextmanager
    def other_text(self, file, change):
        """That file of the copy with another text, for a while."""
        path = self.scratch.tree / file
        text = path.read_text()
        path.write_text(change(text))
        self.assertNotEqual(path.read_text(), text)
        try:
            yield
        finally:
            path.write_text(text)

    def test_the_registry_knows_it_and_its_derivatives_equal_finite_differences(self):
        room = sorted(path.relative_to(self.scratch.tree)
                      for path in (self.scratch.tree / "offline/effects").glob("*.cpp"))
        self.compiles("effects", *room)
        for name in RUNTIME:
            self.compiles(name, f"runtime/src/{name}.cpp")
        done = self.checked()
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        print(done.stdout, end="")
        with self.other_text(STEPS[0].file, without_derivative):
            done = self.checked()
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn("not so: derivatives equal finite differences", done.stderr)

    def test_without_its_line_in_the_descriptors_the_compiler_says_for_which_law_it_is_missing(self):
        file = "offline/effects/descriptors.hpp"
        law = re.search(r"struct (\w+) {", STEPS[0].code)[1]
        with self.other_text(file, lambda text: (SOURCE / file).read_text()):
            objections = self.scratch.compile("incomplete", "offline/effects/registry.cpp", only_read=True)
        self.assertRegex(objections or "", rf"no known conversion .*from '(plumb::effects::)?{law}'")

    def test_the_simulator_hides_it(self):
        law = f"offline/simulate/laws/{LAW}.cpp"
        self.compiles("simulator", law, "offline/simulate/law_entry.cpp", "offline/simulate/law_list.cpp")
        self.assertIn(f"laws/{LAW}.cpp", (self.scratch.tree / "offline/simulate/CMakeLists.txt").read_text())
        self.assertIn(f'of_joints("{LAW}"', (self.scratch.tree / "offline/simulate/law_list.cpp").read_text())


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    COMPILER, LIBRARIES = sys.argv[1], sys.argv[3:]
    HEADERS = set(sys.argv[2].split(";")) - {"", "/usr/include"}  # the compiler looks there by itself, last
    unittest.main(argv=sys.argv[:1], verbosity=2)
