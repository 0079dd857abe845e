#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""One table of what a run of scripts/bench-runtime measured: times, ratios against KDL, budgets.

    runtime_table.py DIR    reads DIR/runtime.json
"""
import sys
from pathlib import Path

sys.dont_write_bytecode = True  # no folder of it beside the sources
from table import Run, duration, head, line, share

WAYS = ("warm", "chain", "cold")
FIRST = ("cycle", "correct", "correct_kinematics", "predict_guard", "predict", "guard", "kinematics")


def verdict(met, limit):
    return f"{limit}: {'met' if met else 'NOT MET'}"


def budgets(run, kdl):
    fk, load = run["forward_kinematics"]["ns"], run["load_and_verify"]
    predict, correct = run["predict_guard/warm"]["ns"], run["correct/warm"]["ns"]
    head("what", "time", "KDL = 1", "budget")
    line("KDL: forward kinematics, 6 joints", duration(kdl), "1", "")
    line("forward kinematics, 6 joints", duration(fk), share(fk / kdl),
         verdict(fk <= 60, "≤ 60 ns") + f"; {kdl / fk:.1f} x as fast, " + verdict(kdl >= 5 * fk, "≥ 5 x"))
    line("predict + guard: 6 effects, 3 x 100 leaves", duration(predict), share(predict / kdl),
         verdict(predict <= 250, "≤ 250 ns"))
    line("correct: the same model", duration(correct), share(correct / kdl),
         verdict(correct <= 2000, "≤ 2 µs"))
    line("load + verify", duration(load["ns"]), share(load["ns"] / kdl),
         verdict(load["ns"] <= 1e6, "≤ 1 ms"))
    line("size of the model", f"{load['bytes'] / 1000:.1f} kB", "",
         verdict(load["bytes"] <= 32000, "≤ 32 kB"))


def adds(name):
    return name.startswith(("effect:", "trees:"))


def order(name):
    """The whole first, then what each effect and each size of tree adds to the kinematics."""
    if name in FIRST:
        return 0, FIRST.index(name), ""
    kind, _, rest = name.partition(":")
    return (2, int(rest), "") if kind == "trees" else (1, 0, name)


def parts(run, kdl):
    base = {way: run[f"kinematics/{way}"]["ns"] for way in WAYS}
    head("part", *WAYS, "warm, KDL = 1")
    names = [name.removesuffix("/warm") for name in run.rows if name.endswith("/warm")]
    for name in sorted(names, key=order):
        times = {way: run[f"{name}/{way}"]["ns"] - (base[way] if adds(name) else 0) for way in WAYS}
        sign = "+" if adds(name) else ""
        cells = [f"{times[way]:{sign}.0f} ns" for way in WAYS]
        line(name, *cells, share(times["warm"] / kdl))


def main():
    run = Run(Path(sys.argv[1]) / "runtime.json")
    kdl = run["forward_kinematics_kdl"]["ns"]
    print("Medians of processor time in one run (cold: wall time). Quote the ratios: the times are this machine's, now.")
    budgets(run, kdl)
    parts(run, kdl)


main()
