#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""plumb.Cell answers what the program prints, for every sample cell, and its errors are exceptions.

usage: cell_test.py PROGRAM LIBRARY
"""
import os
import pathlib
import pickle
import signal
import stat
import threading
import time
import unittest
import warnings

from support import Case, demos, main, plumb, printed
from kept_whole import lost


class Verbs(Case):

    def agree(self, answer, json):
        self.assertEqual(answer.json, json)
        self.assertEqual(list(lost(answer.result, json["result"])), [])
        self.assertEqual(list(lost(answer.warnings, json["warnings"])), [])
        self.assertEqual(list(lost(answer.inputs, json["inputs"])), [])

    def test_fit_and_compare_of_every_sample_cell(self):
        names = demos()
        self.assertGreater(len(names), 10)
        for name in names:
            with self.subTest(name):
                cell = self.demo(name)
                self.agree(cell.fit(dry_run=True), printed("-C", cell.folder, "fit", "--dry-run"))
                cell.fit()
                self.agree(cell.compare(), printed("-C", cell.folder, "compare"))

    def test_the_other_verbs_of_a_cell(self):
        cell = self.demo("scara")
        self.agree(cell.check(), printed("-C", cell.folder, "check"))
        cell.fit()
        self.agree(cell.diagnose(), printed("-C", cell.folder, "diagnose"))
        self.agree(cell.plan(n=5, dry_run=True), printed("-C", cell.folder, "plan", "--n", 5, "--dry-run"))
        self.assertEqual(cell.add("joint_compliance", joints=["J1", "J2"]).command, "add")
        self.assertEqual(cell.drop("joint_compliance").command, "drop")
        self.agree(cell.diff(1, 2), printed("-C", cell.folder, "diff", 1, 2))
        self.agree(cell.runs(), printed("-C", cell.folder, "runs"))

    def test_options_are_written_as_the_program_reads_them(self):
        words = plumb.program.words_of({"held_out": "kfold:5", "apply": True, "force": False, "run": None, "joints": ["J2", "J3"],
                                        "map": {"x": "x_mm", "y": "y_mm"}, "output": pathlib.Path("a b.csv"), "from_": 1})
        self.assertEqual(words, ["--held-out=kfold:5", "--apply", "--joints=J2,J3", "--map=x=x_mm", "--map=y=y_mm",
                                 "--output=a b.csv", "--from=1"])

    def test_members_of_a_newer_program_are_passed_over(self):
        cell = self.demo("clean")
        cell.fit()
        json = printed("-C", cell.folder, "compare")
        json["result"]["of_next_year"] = json["result"]["by"]["of_next_year"] = {"x": 1}
        answer = plumb.answer.answer_of(json, plumb.results.Compare, None)
        self.assertEqual(answer.result.n, json["result"]["n"])
        self.assertEqual(answer.json, json)


class Shown(Case):

    def test_an_answer_is_a_page_with_its_figure(self):
        cell = self.demo("mixed")
        cell.fit()
        page = cell.compare()._repr_html_()
        self.assertIn('<img alt="error-map" src="data:image/svg+xml;base64,PHN2Zy', page)
        self.assertIn("Not good enough", page)
        self.assertIn("<th>readings</th>", page)
        self.assertIn("<th>member</th>", plumb.Program().explain("E-USAGE")._repr_html_())

    def test_words_of_a_cell_are_no_markup(self):
        block = [{"kind": "sentence", "words": "<script>1 < 2</script>", "class": ""}]
        page = plumb.notebook.page({"result": {"blocks": block}, "warnings": []}, None)
        self.assertIn("<p>&lt;script&gt;1 &lt; 2", page)


class Messages(Case):

    def test_warnings_are_warned_and_kept(self):
        cell = self.demo("mixed")
        with self.assertWarnsRegex(plumb.PlumbWarning, "W-FIT-OUTLIERS: .*contradict") as caught:
            answer = cell.fit()
        self.assertEqual(caught.filename, __file__)  # the line that called
        self.assertEqual([one.code for one in answer.warnings], ["W-FIT-OUTLIERS"])

    def test_notes_are_kept_only(self):
        cell = self.demo("clean")
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            cell.fit()
            cell.compile()

    def test_a_missing_cell(self):
        with self.assertRaises(plumb.PlumbError) as caught:
            plumb.Cell(self.folder / "nowhere").fit()
        error = caught.exception
        expected = printed("-C", self.folder / "nowhere", "fit")["error"]
        self.assertEqual((error.code, error.message, error.help, error.exit_code),
                         tuple(expected[part] for part in ("code", "message", "help", "exit")))
        self.assertIn(f"{error.code}: {error.message}", str(error))
        self.assertEqual(str(pickle.loads(pickle.dumps(error))), str(error))

    def test_an_error_in_a_file_has_its_place(self):
        cell = self.demo("clean")
        file = cell.folder / "measurements.csv"
        file.write_text(file.read_text().replace("x_mm", "x", 1))
        with self.assertRaisesRegex(plumb.PlumbError, "E-CSV-UNIT: .*\n  --> .*measurements.csv:[0-9]+:[0-9]+\n  = help: "):
            cell.fit()

    def test_a_failed_gate_has_its_result(self):
        cell = self.demo("mixed")
        with self.assertRaises(plumb.PlumbError) as caught:
            cell.fit(max_rms=0.001)
        self.assertEqual(caught.exception.exit_code, 1)
        self.assertGreater(caught.exception.json["result"]["held_out"]["rms_mm"], 0.001)

    def test_an_option_that_is_none(self):
        with self.assertRaises(plumb.PlumbError) as caught:
            self.demo("clean").fit(no_such_option=1)
        self.assertEqual(caught.exception.exit_code, 2)


class TheProgram(Case):
    """Found, followed and interrupted; a small script stands for it."""

    def setUp(self):
        super().setUp()
        kept = os.environ["PLUMB"]
        self.addCleanup(os.environ.__setitem__, "PLUMB", kept)

    def instead(self, *lines):
        script = self.folder / "instead"
        script.write_text("#!/bin/sh\n" + "\n".join(lines) + "\n")
        script.chmod(script.stat().st_mode | stat.S_IXUSR)
        os.environ["PLUMB"] = str(script)

    def test_a_missing_program_is_named_with_its_remedy(self):
        os.environ["PLUMB"] = "no-such-plumb"
        with self.assertRaisesRegex(FileNotFoundError, "'no-such-plumb' is not installed: .*variable PLUMB"):
            plumb.Cell(".").fit()

    def test_progress_is_told_step_by_step(self):
        self.instead("echo 'fitting 10 poses: step 1 of 2 ...' >&2", "echo 'warning[W-X]: not a step' >&2",
                     "echo 'fitting 10 poses: step 2 of 2 ...' >&2", "echo '{\"error\": {\"code\": \"E-X\", \"message\": \"no\", "
                     "\"help\": \"\", \"exit\": 4, \"place\": null}}'", "exit 4")
        said = []
        with self.assertRaisesRegex(plumb.PlumbError, "^E-X: no$"):
            plumb.Cell(".").fit(progress=said.append)
        self.assertEqual(said, ["fitting 10 poses: step 1 of 2", "fitting 10 poses: step 2 of 2"])

    def test_a_program_that_breaks_is_no_answer(self):
        self.instead("echo 'Segmentation fault' >&2", "exit 139")
        with self.assertRaisesRegex(RuntimeError, "ended with 139 and without an answer: Segmentation fault"):
            plumb.Cell(".").fit()

    def test_an_interruption_ends_the_program(self):
        gone = self.folder / "gone"
        self.instead(f"trap 'touch {gone}; exit 130' INT", "echo 'at work ...' >&2", "while :; do sleep 0.1; done")
        begun = threading.Event()
        threading.Thread(target=lambda: (begun.wait(10), time.sleep(0.2), os.kill(os.getpid(), signal.SIGINT)), daemon=True).start()
        with self.assertRaises(KeyboardInterrupt):
            plumb.Cell(".").fit(progress=lambda step: begun.set())
        self.assertTrue(gone.exists())


if __name__ == "__main__":
    main()
