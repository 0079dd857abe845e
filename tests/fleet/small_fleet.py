# SPDX-License-Identifier: Apache-2.0
"""Fleets of small cells for the tests beside this file, and what these count."""
import json
import os
import pathlib
import shutil
import subprocess
import sys

passed = failed = 0


def check(holds, what, detail=""):
    """Counts it, and names it if it does not hold."""
    global passed, failed
    if holds:
        passed += 1
    else:
        failed += 1
        detail = str(detail).strip()
        print(f"FAILED: {what}{': ' if detail else ''}{detail[:400]}", flush=True)
    return holds


def finish():
    print(f"{passed} checks passed, {failed} failed")
    sys.exit(0 if failed == 0 and passed > 0 else 1)


def ran(command, **options):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, errors="replace", **options)


def make_cells(plumb, folder, names, poses=60, first_seed=1):
    """One arm's cell under every name, each measured with a seed of its own."""
    folder.mkdir(parents=True, exist_ok=True)
    base = folder / "base"
    ran([plumb, "demo", "compliance", base], check=True)
    for seed, name in enumerate(names, first_seed):
        cell = folder / name
        shutil.copytree(base, cell)
        ran([plumb, "-C", cell, "simulate", "--poses", poses, "--seed", seed, "--force"], check=True)
        for left in ("truth.json", "targets.csv"):
            (cell / left).unlink()
    shutil.rmtree(base)


def files_of(folder):
    """Bytes of every file of a results folder by its path, but for what Slurm's tasks print."""
    return {str(at.relative_to(folder)): at.read_bytes() for at in sorted(pathlib.Path(folder).rglob("*"))
            if at.is_file() and at.relative_to(folder).parts[0] != "slurm"}


def differing(a, b):
    """What differs between two results of files_of(), in words; empty if nothing."""
    names = sorted(name for name in a.keys() | b.keys() if a.get(name) != b.get(name))
    return ", ".join(f"{name} {'differs' if name in a and name in b else 'is in one only'}" for name in names)


def kept_files(results):
    """The kept result of every cell: its file by the name of the cell. One that is not whole is left out."""
    out = {}
    for at in (pathlib.Path(results) / "cells").rglob("*"):
        if at.is_file() and at.suffix == ".json":
            try:
                out[json.loads(at.read_bytes())["name"]] = at
            except (ValueError, KeyError):
                pass
    return out


def stamps(results):
    """Which file each kept result is: written anew, it is another one."""
    out = {}
    for name, at in kept_files(results).items():
        found = os.stat(at)
        out[name] = (found.st_ino, found.st_mtime_ns)
    return out


def drafts(folder):
    return [str(at) for at in pathlib.Path(folder).rglob("*.tmp*")]
