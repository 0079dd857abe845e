#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""scikit-learn's regression tree and Gaussian process on the data that bench_trees --data wrote.

    peers.py DIR    reads DIR/*.csv, writes DIR/peers.json: times [ns], errors [m]
"""
import json
import statistics
import sys
import time
from pathlib import Path

import numpy
import sklearn
from sklearn.gaussian_process import GaussianProcessRegressor
from sklearn.gaussian_process.kernels import RBF, ConstantKernel
from sklearn.tree import DecisionTreeRegressor

LEAVES = 93  # as many as our trees of the study
SINGLE_ROWS = 300


def read(path):
    table = numpy.loadtxt(path, delimiter=",", skiprows=1)
    return table[:, :2], table[:, 2:]


def median_ns(work, repetitions):
    times = []
    for _ in range(repetitions):
        begin = time.perf_counter_ns()
        work()
        times.append(time.perf_counter_ns() - begin)
    return statistics.median(times)


def errors(y, predicted):
    e = numpy.linalg.norm(y - predicted, axis=1)
    return {"e_avg_m": e.mean(), "e_max_m": e.max()}


def single_row_ns(predict, u):
    rows = [u[i : i + 1] for i in range(0, len(u), len(u) // SINGLE_ROWS)]
    return statistics.median(median_ns(lambda r=r: predict(r), 1) for r in rows)


def cart(train, test, repetitions, **limits):
    """A tree an axis, as ours; fit_ns is for one axis, predictions are for both."""
    (u, y), (test_u, test_y) = train, test
    trees = [DecisionTreeRegressor(random_state=0, **limits).fit(u, y[:, k]) for k in range(2)]
    both = lambda rows: numpy.column_stack([tree.predict(rows) for tree in trees])
    fit = lambda: DecisionTreeRegressor(random_state=0, **limits).fit(u, y[:, 0])
    return {
        "leaves": int(trees[0].get_n_leaves()),
        "fit_ns": median_ns(fit, repetitions),
        "row_ns": single_row_ns(both, test_u),
        "batch_ns": median_ns(lambda: both(test_u), repetitions) / len(test_u),
        **errors(test_y, both(test_u)),
    }


def gaussian_process(train, test):
    (u, y), (test_u, test_y) = train, test
    kernel = ConstantKernel(1.0) * RBF([1.0, 1.0], (1e-2, 1e2))
    model = GaussianProcessRegressor(kernel, alpha=1e-10, normalize_y=True, random_state=0)
    return {
        "fit_ns": median_ns(lambda: model.fit(u, y), 1),
        "row_ns": single_row_ns(model.predict, test_u),
        "batch_ns": median_ns(lambda: model.predict(test_u), 3) / len(test_u),
        **errors(test_y, model.predict(test_u)),
    }


def main():
    folder = Path(sys.argv[1])
    residual = [read(folder / f"residual_{part}.csv") for part in ("train", "test")]
    positions = [read(folder / f"positions_{part}.csv") for part in ("train", "test")]
    out = {
        "version": sklearn.__version__,
        "cart": cart(*residual, 25, max_leaf_nodes=LEAVES),
        "cart_grown_out": cart(*residual, 25),
        "cart_fine": cart(*positions, 3, min_samples_leaf=31),
        "gaussian_process": gaussian_process(*residual),
    }
    (folder / "peers.json").write_text(json.dumps(out, indent=2))


main()
