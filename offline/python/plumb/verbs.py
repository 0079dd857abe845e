# SPDX-License-Identifier: Apache-2.0
# Made from docs/schemas by tests/pages/python_types.py; do not edit.
"""The verbs of plumb as methods."""
from __future__ import annotations

from typing import Optional, TypeVar

from . import results
from .answer import Answer, Option, Progress, Word

Result = TypeVar("Result")


class Verbs:
    """Words are what stands behind the verb, options what begins with two dashes: held_out="kfold:5"."""

    def _run(self, verb: str, words: tuple[Word, ...], options: dict[str, Option], kind: type[Result],
             progress: Optional[Progress]) -> Answer[Result]:
        raise NotImplementedError

    def add(self, *words: Word, progress: Optional[Progress] = None,
            **options: Option) -> Answer[results.Add]:
        """Puts an effect into the model and fits again. Options: plumb add --help"""
        return self._run("add", words, options, results.Add, progress)

    def bench(self, *words: Word, progress: Optional[Progress] = None,
              **options: Option) -> Answer[results.Bench]:
        """How long a cycle takes. Options: plumb bench --help"""
        return self._run("bench", words, options, results.Bench, progress)

    def check(self, *words: Word, progress: Optional[Progress] = None,
              **options: Option) -> Answer[results.Check]:
        """Judges the files of a cell: units, conventions, coverage, and what the data can show. Options: plumb check --help"""
        return self._run("check", words, options, results.Check, progress)

    def compare(self, *words: Word, progress: Optional[Progress] = None,
                **options: Option) -> Answer[results.Compare]:
        """Holds the model against the measurements. Options: plumb compare --help"""
        return self._run("compare", words, options, results.Compare, progress)

    def compile(self, *words: Word, progress: Optional[Progress] = None,
                **options: Option) -> Answer[results.Compile]:
        """Makes the model file. Options: plumb compile --help"""
        return self._run("compile", words, options, results.Compile, progress)

    def correct(self, *words: Word, progress: Optional[Progress] = None,
                **options: Option) -> Answer[results.Correct]:
        """What to command so that the arm reaches a target. Options: plumb correct --help"""
        return self._run("correct", words, options, results.Correct, progress)

    def dbc(self, *words: Word, progress: Optional[Progress] = None,
            **options: Option) -> Answer[results.Dbc]:
        """The CAN layout as a DBC file. Options: plumb dbc --help"""
        return self._run("dbc", words, options, results.Dbc, progress)

    def demo(self, *words: Word, progress: Optional[Progress] = None,
             **options: Option) -> Answer[results.Demo]:
        """Writes a sample cell. Options: plumb demo --help"""
        return self._run("demo", words, options, results.Demo, progress)

    def deploy(self, *words: Word, progress: Optional[Progress] = None,
               **options: Option) -> Answer[results.Deploy]:
        """Writes the folder that plumb-rt runs. Options: plumb deploy --help"""
        return self._run("deploy", words, options, results.Deploy, progress)

    def diagnose(self, *words: Word, progress: Optional[Progress] = None,
                 **options: Option) -> Answer[results.Diagnose]:
        """Says which physical effect is missing. Options: plumb diagnose --help"""
        return self._run("diagnose", words, options, results.Diagnose, progress)

    def diff(self, *words: Word, progress: Optional[Progress] = None,
             **options: Option) -> Answer[results.Diff]:
        """Says what changed between two runs. Options: plumb diff --help"""
        return self._run("diff", words, options, results.Diff, progress)

    def drop(self, *words: Word, progress: Optional[Progress] = None,
             **options: Option) -> Answer[results.Drop]:
        """Takes an effect out of the model and fits again. Options: plumb drop --help"""
        return self._run("drop", words, options, results.Drop, progress)

    def explain(self, *words: Word, progress: Optional[Progress] = None,
                **options: Option) -> Answer[results.Explain]:
        """Offline help. Options: plumb explain --help"""
        return self._run("explain", words, options, results.Explain, progress)

    def export(self, *words: Word, progress: Optional[Progress] = None,
               **options: Option) -> Answer[results.Export]:
        """Writes the arm as URDF. Options: plumb export --help"""
        return self._run("export", words, options, results.Export, progress)

    def filter(self, *words: Word, progress: Optional[Progress] = None,
               **options: Option) -> Answer[results.Filter]:
        """Robot programs with corrected targets. Options: plumb filter --help"""
        return self._run("filter", words, options, results.Filter, progress)

    def fit(self, *words: Word, progress: Optional[Progress] = None,
            **options: Option) -> Answer[results.Fit]:
        """Calibrates the arm. Options: plumb fit --help"""
        return self._run("fit", words, options, results.Fit, progress)

    def fleet(self, *words: Word, progress: Optional[Progress] = None,
              **options: Option) -> Answer[results.Fleet]:
        """Many cells: which arms are good, which is unlike its sisters, what is typical. Options: plumb fleet --help"""
        return self._run("fleet", words, options, results.Fleet, progress)

    def import_(self, *words: Word, progress: Optional[Progress] = None,
                **options: Option) -> Answer[results.Import]:
        """Turns a tracker's or a controller's text file into measurements.csv. Options: plumb import --help"""
        return self._run("import", words, options, results.Import, progress)

    def inspect(self, *words: Word, progress: Optional[Progress] = None,
                **options: Option) -> Answer[results.Inspect]:
        """What is in a model file. Options: plumb inspect --help"""
        return self._run("inspect", words, options, results.Inspect, progress)

    def keygen(self, *words: Word, progress: Optional[Progress] = None,
               **options: Option) -> Answer[results.Keygen]:
        """A new pair of keys. Options: plumb keygen --help"""
        return self._run("keygen", words, options, results.Keygen, progress)

    def modbus_map(self, *words: Word, progress: Optional[Progress] = None,
                   **options: Option) -> Answer[results.ModbusMap]:
        """The Modbus registers. Options: plumb modbus-map --help"""
        return self._run("modbus-map", words, options, results.ModbusMap, progress)

    def new(self, *words: Word, progress: Optional[Progress] = None,
            **options: Option) -> Answer[results.New]:
        """Writes a commented cell.toml. Options: plumb new --help"""
        return self._run("new", words, options, results.New, progress)

    def plan(self, *words: Word, progress: Optional[Progress] = None,
             **options: Option) -> Answer[results.Plan]:
        """Chooses the next poses to measure. Options: plumb plan --help"""
        return self._run("plan", words, options, results.Plan, progress)

    def plot(self, *words: Word, progress: Optional[Progress] = None,
             **options: Option) -> Answer[results.Plot]:
        """One figure of a run as an SVG file. Options: plumb plot --help"""
        return self._run("plot", words, options, results.Plot, progress)

    def predict(self, *words: Word, progress: Optional[Progress] = None,
                **options: Option) -> Answer[results.Predict]:
        """Where the arm truly is. Options: plumb predict --help"""
        return self._run("predict", words, options, results.Predict, progress)

    def recheck(self, *words: Word, progress: Optional[Progress] = None,
                **options: Option) -> Answer[results.Recheck]:
        """Judges few new readings against a run: still true, or what has changed. Options: plumb recheck --help"""
        return self._run("recheck", words, options, results.Recheck, progress)

    def report(self, *words: Word, progress: Optional[Progress] = None,
               **options: Option) -> Answer[results.Report]:
        """One self-contained HTML file about a run. Options: plumb report --help"""
        return self._run("report", words, options, results.Report, progress)

    def runs(self, *words: Word, progress: Optional[Progress] = None,
             **options: Option) -> Answer[results.Runs]:
        """Lists the history. Options: plumb runs --help"""
        return self._run("runs", words, options, results.Runs, progress)

    def simulate(self, *words: Word, progress: Optional[Progress] = None,
                 **options: Option) -> Answer[results.Simulate]:
        """Simulates measurements of an arm with hidden errors. Options: plumb simulate --help"""
        return self._run("simulate", words, options, results.Simulate, progress)

    def study(self, *words: Word, progress: Optional[Progress] = None,
              **options: Option) -> Answer[results.Study]:
        """Reproduces the published study. Options: plumb study --help"""
        return self._run("study", words, options, results.Study, progress)
