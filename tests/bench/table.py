#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""One table of what a run of scripts/bench-trees measured: times, errors, ratios and goals.

    table.py DIR    reads DIR/{trees,solve,runtime,peers}.json
"""
import json
import math
import sys
from pathlib import Path


class Run:
    """Medians of Google Benchmark's repetitions, in [ns]: processor time, or wall time where the
    benchmark runs on several processors, or times single calls, and says so."""

    def __init__(self, path):
        scale = {"ns": 1.0, "us": 1e3, "ms": 1e6, "s": 1e9}
        self.rows = {}
        for row in json.loads(path.read_text())["benchmarks"]:
            if row.get("aggregate_name", "median") == "median":
                name, _, _ = row["run_name"].partition("/iterations:")
                wall = row["run_name"].endswith(("/real_time", "/manual_time"))
                name = name.removesuffix("/real_time")
                clock = "real_time" if wall else "cpu_time"
                row["ns"] = row[clock] * scale[row["time_unit"]]
                self.rows[name] = row

    def __getitem__(self, name):
        return self.rows[name]


def duration(ns):
    for unit, size in (("s", 1e9), ("ms", 1e6), ("µs", 1e3)):
        if ns >= size:
            return f"{ns / size:.3g} {unit}"
    return f"{ns:.3g} ns"


def length(m):
    return f"{m * 1e3:.3g} mm" if m >= 1e-4 else f"{m * 1e6:.3g} µm"


def share(ratio):
    return f"{ratio:.2f}" if ratio < 10 else f"{ratio:.0f}" if ratio < 1e4 else f"{ratio:.1e}"


def line(*cells):
    print("| " + " | ".join(cells) + " |")


def head(*cells):
    print()
    line(*cells)
    line(*["---"] * len(cells))


def timed(what, ours, peer, ns, goal=None):
    """ns: of the peer. The ratio says how many times as long the peer takes."""
    verdict = "" if goal is None else f"≤ {duration(goal)}: {'met' if ours <= goal else 'MISSED'}"
    line(what, duration(ours), peer, duration(ns), share(ns / ours), verdict)


def times(trees, solve, runtime, peers):
    cart, process = peers["cart"], peers["gaussian_process"]
    head("what", "ours", "peer", "its time", "peer / ours", "goal")
    timed("crisp growth, 1536 poses, 93 leaves, an axis", trees["grow_crisp"]["ns"],
          "CART, 93 leaves", cart["fit_ns"], 2e6)
    timed("crisp growth, 148,680 poses, an axis", trees["grow_fine"]["ns"],
          f"CART, {peers['cart_fine']['leaves']} leaves", peers["cart_fine"]["fit_ns"], 0.15e9)
    timed("blended training, 1536 poses, 93 leaves, both axes", trees["grow_blended"]["ns"],
          "Gaussian process", process["fit_ns"])
    depth = trees["crisp_evaluate"]["depth"]
    timed(f"crisp value, 3 x 100 leaves, 6 joints, depth {depth:.0f}", trees["crisp_evaluate"]["ns"],
          "pointers", trees["crisp_evaluate_naive"]["ns"])
    timed("the same as the cycle calls it", trees["crisp_tree_error"]["ns"],
          "pointers", trees["crisp_evaluate_naive"]["ns"], 60)
    timed("blended value, 93 leaves, 2 joints", trees["blended_evaluate"]["ns"],
          "pointers", trees["blended_evaluate_naive"]["ns"], 150)
    crisp, blended = trees["study_batch/0"]["ns"], trees["study_batch/1"]["ns"]
    timed("a pose, x and y, crisp 93 leaves", crisp, "CART, one row", cart["row_ns"])
    timed("a pose, x and y, crisp 93 leaves", crisp, "CART, all 5985 rows", cart["batch_ns"])
    timed("a pose, x and y, blended 93 leaves", blended, "GP, one row", process["row_ns"])
    timed("a pose, x and y, blended 93 leaves", blended, "GP, all 5985 rows", process["batch_ns"])
    timed("forward kinematics, 6 joints", runtime["forward_kinematics"]["ns"], "KDL",
          runtime["forward_kinematics_kdl"]["ns"])
    fit = solve["global_solve"]
    gigabytes = fit["peak_bytes"] / 1e9
    print(f"\nGlobal solve, 148,680 poses, {fit['leaves']:.0f} leaves: {duration(fit['ns'])} "
          f"(goal 10 s: {'met' if fit['ns'] <= 1e10 else 'MISSED'}), peak {gigabytes:.2f} GB "
          f"(goal 4 GB: {'met' if gigabytes <= 4 else 'MISSED'}).")


def accuracy(trees, peers):
    head("errors on the study's test grid", "leaves", "mean", "largest")
    for name, row in (("ours, crisp", trees["grow_crisp"]), ("ours, blended", trees["grow_blended"]),
                      ("CART", peers["cart"]), ("CART, grown out", peers["cart_grown_out"]),
                      ("Gaussian process", peers["gaussian_process"]),
                      ("148,680 poses: ours, crisp", trees["grow_fine"]),
                      ("148,680 poses: CART", peers["cart_fine"])):
        leaves = f"{row['leaves']:.0f}" if "leaves" in row else ""
        line(name, leaves, length(row["e_avg_m"]), length(row["e_max_m"]))


def growth(trees):
    head("n", "growth", "time / (n log2 n)")
    costs = []
    for name, row in sorted(trees.rows.items(), key=lambda item: item[1].get("n", 0)):
        if not name.startswith("grow_n/"):
            continue
        costs.append(row["ns"] / (row["n"] * math.log2(row["n"])))
        line(f"{row['n']:.0f}", duration(row["ns"]), f"{costs[-1]:.1f} ns")
    print(f"\nLargest of these over the smallest: {max(costs) / min(costs):.2f}.")


def main():
    folder = Path(sys.argv[1])
    trees, solve, runtime = (Run(folder / f"{name}.json") for name in ("trees", "solve", "runtime"))
    peers = json.loads((folder / "peers.json").read_text())
    print(f"scikit-learn {peers['version']}; medians: processor time of ours where one thread runs, else wall time.")
    times(trees, solve, runtime, peers)
    accuracy(trees, peers)
    growth(trees)


if __name__ == "__main__":
    main()
