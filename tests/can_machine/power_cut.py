#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Inside the emulated machine: the power fails while models are installed, swapped and rolled back and a record is
written. The disk of each cut is mounted, and what is on it is judged (logged_disk.py).

  power_cut.py PLUMB_RT FOLDERS CUTS SEED [LIBRARY]

FOLDERS: what plumb deploy wrote, signed: `a`, `b`, `c`, and `run` and `run2`, which run from a file of targets; `etc`
has the key. LIBRARY is loaded into plumb-rt while it writes: a planted fault, which must be found."""
import os
import pathlib
import re
import signal
import subprocess
import sys
import time

from logged_disk import AT, MOUNTED, WORK, LoggedDisk

PLUMB_RT, FOLDERS, CUTS, SEED = sys.argv[1], pathlib.Path(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4])
PLANTED = sys.argv[5] if len(sys.argv) > 5 else None
PLACE = AT / "cell"
RECORD_LINE = re.compile(rb"^\(\d+\.\d{6}\) \S+ \S+$")


def loaded():
    return {**os.environ, "LD_PRELOAD": PLANTED} if PLANTED else dict(os.environ)


def plumb_rt(*words):
    rules = ["--etc", FOLDERS / "etc"] if words[0] in ("install", "rollback", "verify", "run") else []
    return subprocess.run([PLUMB_RT, *[str(word) for word in [*words, *rules]]], capture_output=True, text=True, env=loaded())


def current(place=PLACE):
    link = place / "current"
    return os.readlink(link) if link.is_symlink() else None


def story(disk):
    """What happens on the disk. Its state is the version that is current."""
    def step(name, *words):
        def command():
            done = plumb_rt(*words)
            if done.returncode != 0:
                raise SystemExit(f"{name}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
        disk.step(name, current, command)

    step("install a", "install", FOLDERS / "a", "--to", PLACE)
    step("install b", "install", FOLDERS / "b", "--to", PLACE)
    step("roll back to a", "rollback", "--to", PLACE)
    step("install c", "install", FOLDERS / "c", "--to", PLACE)
    step("install b again", "install", FOLDERS / "b", "--to", PLACE, "--older")
    step("install what runs from a file", "install", FOLDERS / "run", "--to", PLACE)
    with open(WORK / "rt.log", "w") as out:
        service = subprocess.Popen([PLUMB_RT, "run", PLACE, "--priority", "0", "--etc", FOLDERS / "etc"], stdout=out, stderr=out, env=loaded())
        until = time.monotonic() + 60
        while plumb_rt("status", PLACE).returncode != 0:
            if time.monotonic() > until or service.poll() is not None:
                raise SystemExit("it does not run:\n" + (WORK / "rt.log").read_text())
            time.sleep(0.5)
        time.sleep(3)
        step("swap while it runs", "install", FOLDERS / "run2", "--to", PLACE)
        time.sleep(3)
        step("roll back while it runs", "rollback", "--to", PLACE)
        time.sleep(2)
        service.send_signal(signal.SIGTERM)
        service.wait(60)


def judged(allowed):
    """What is wrong with the mounted disk; empty if nothing is."""
    place = MOUNTED / "cell"
    now = current(place)
    if str(now) not in allowed:
        return f"current is {now}, and must be {' or '.join(sorted(allowed))}"
    if now is None:
        return ""
    done = plumb_rt("verify", "--to", place)
    if done.returncode != 0:
        return f"verify: {done.stdout}{done.stderr}"
    (WORK / "corrected.csv").unlink(missing_ok=True)  # one that is there is never replaced
    check = plumb_rt("run", place, "--check", "--priority", "0")
    if check.returncode != 0:
        return f"run --check: {check.stdout}{check.stderr}"
    for record in place.glob("record.log*"):
        lines = record.read_bytes().split(b"\n")
        bad = [i for i, line in enumerate(lines[:-1]) if line and not RECORD_LINE.match(line)]
        if bad:
            return f"{record.name}: line {bad[0] + 1} of {len(lines)} is {lines[bad[0]][:60]!r}"
    return ""


def main():
    with LoggedDisk(32) as disk:
        story(disk)
    faults, cuts = disk.faults_of_cuts(CUTS, SEED, judged, "found " if PLANTED else "FAILED")
    if PLANTED:
        print(f"{'ok    ' if faults else 'FAILED'} planted: without waiting for the disk {faults} of {cuts} cuts leave a fault")
        return 0 if faults else 1
    print(f"{'ok    ' if faults == 0 else 'FAILED'} after {cuts} cuts of the power one of the two models is there, whole, and runs;"
          f" {faults} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
