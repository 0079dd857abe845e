#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The example in Python does what it says, from the sources and from the wheel, and needs no compiler.

usage: example_test.py PROGRAM LIBRARY
"""
import base64
import csv
import hashlib
import os
import subprocess
import sys
import zipfile

from support import PACKAGE, SOURCE, Case, main, plumb

EXAMPLE = SOURCE / "examples/08_from_python.py"


class Example(Case):

    def run_with(self, path, cell):
        return subprocess.run([sys.executable, "-B", EXAMPLE, cell.folder], check=True, capture_output=True, text=True,
                              env={**os.environ, "PYTHONPATH": str(path), "PATH": "/nonexistent"}).stdout

    def test_goes_from_measurements_to_corrected_targets(self):
        said = self.run_with(PACKAGE, self.demo("mixed"))
        self.assertRegex(said, "Missing: J2 and J3 yield under load.*'joint_compliance'")
        self.assertRegex(said, r"20 targets, 0 refused, the largest correction is [0-9]\.[0-9]*[1-9][0-9]* mm\n$")

    def test_says_what_the_command_says(self):
        cell = self.demo("mixed")
        largest = self.run_with(PACKAGE, cell).rpartition("correction is ")[2].partition(" mm")[0]
        out = cell.folder / "out.csv"
        answer = cell.correct(cell.folder / "robot.plumb", data=cell.folder / "targets.csv", output=out)
        self.assertEqual(largest, f"{answer.result.largest_mm:.3f}")
        with open(out, encoding="utf-8") as lines:
            self.assertEqual(len(list(csv.DictReader(lines))), 20)

    def test_is_short(self):
        lines = [line for line in EXAMPLE.read_text().splitlines() if line and not line.startswith(("#", "import"))]
        self.assertLessEqual(len(lines), 14)


class Wheel(Case):

    def made(self, folder):
        script = SOURCE / "scripts/python-wheel"
        name = subprocess.run([script, self.folder / folder], check=True, capture_output=True, text=True).stdout
        return self.folder / folder / os.path.basename(name.strip())

    def test_runs_the_example(self):
        self.assertIn("20 targets, 0 refused", Example.run_with(self, self.made("wheel"), self.demo("mixed")))  # Python imports from zip files, too

    def test_records_every_file(self):
        wheel = self.made("wheel")
        self.assertEqual(wheel.name, f"plumb-{plumb.__version__}-py3-none-any.whl")
        with zipfile.ZipFile(wheel) as inside:
            info = f"plumb-{plumb.__version__}.dist-info"
            record = list(csv.reader(inside.read(f"{info}/RECORD").decode().splitlines()))
            self.assertEqual([row[0] for row in record], inside.namelist())
            for name, digest, size in record[:-1]:
                data = inside.read(name)
                found = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
                self.assertEqual((f"sha256={found}", str(len(data))), (digest, size))
            self.assertIn("plumb/py.typed", inside.namelist())
            self.assertIn("Requires-Dist: numpy", inside.read(f"{info}/METADATA").decode())

    def test_is_the_same_to_the_byte(self):
        self.assertEqual(self.made("a").read_bytes(), self.made("b").read_bytes())


if __name__ == "__main__":
    main()
