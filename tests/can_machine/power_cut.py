#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Inside the emulated machine: every write to a small disk is logged while models are installed, swapped and rolled
back and a record is written. Then the disk is made anew as a cut of the power would have left it at many of these
writes, mounted, and what is on it is judged.

  power_cut.py PLUMB_RT FOLDERS CUTS SEED [LIBRARY]

FOLDERS: what plumb deploy wrote, signed: `a`, `b`, `c`, and `run` and `run2`, which run from a file of targets; `etc`
has the key. LIBRARY is loaded into plumb-rt while it writes: a planted fault, which must be found.

The kernel's target log-writes keeps each write in the order in which it ended, and with it what was flushed; what was
still in memory is not in the log. So a disk made of the first n entries is one that a cut may leave. Its format:
Documentation/admin-guide/device-mapper/log-writes.rst of the kernel."""
import os
import pathlib
import random
import re
import signal
import struct
import subprocess
import sys
import time

PLUMB_RT, FOLDERS, CUTS, SEED = sys.argv[1], pathlib.Path(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4])
PLANTED = sys.argv[5] if len(sys.argv) > 5 else None
WORK = pathlib.Path("/run/cut")
DISK, LOG, IMAGE, MOUNTED = WORK / "disk", WORK / "log", WORK / "image", WORK / "mounted"
AT = WORK / "at"
PLACE = AT / "cell"
DISK_BYTES, LOG_BYTES = 32 << 20, 600 << 20
DISCARD, MARK = 4, 8
RECORD_LINE = re.compile(rb"^\(\d+\.\d{6}\) \S+ \S+$")


def run(*command, **options):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, **options)
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(map(str, command))}: {done.stderr}")
    return done.stdout.strip()


def loaded():
    return {**os.environ, "LD_PRELOAD": PLANTED} if PLANTED else dict(os.environ)


def plumb_rt(*words):
    rules = ["--etc", FOLDERS / "etc"] if words[0] in ("install", "rollback", "verify", "run") else []
    return subprocess.run([PLUMB_RT, *[str(word) for word in [*words, *rules]]], capture_output=True, text=True, env=loaded())


def current(place=PLACE):
    link = place / "current"
    return os.readlink(link) if link.is_symlink() else None


class Log:
    """The logged disk while it is written."""

    def __enter__(self):
        WORK.mkdir()
        AT.mkdir()
        loops = []
        for file, size in ((DISK, DISK_BYTES), (LOG, LOG_BYTES)):
            with open(file, "wb") as out:
                out.truncate(size)
            loops.append(run("losetup", "--find", "--show", file))
        run("dmsetup", "--noudevsync", "create", "cut", "--table", f"0 {DISK_BYTES // 512} log-writes {loops[0]} {loops[1]}")
        run("dmsetup", "mknodes")
        run("mkfs.ext4", "-q", "-J", "size=4", "/dev/mapper/cut")
        run("mount", "-o", "commit=1", "/dev/mapper/cut", AT)
        run("sync")
        return self

    def mark(self, words):
        run("dmsetup", "--noudevsync", "message", "cut", "0", "mark", words)

    def __exit__(self, *_):
        run("umount", AT)
        run("dmsetup", "--noudevsync", "remove", "cut")
        run("losetup", "--detach-all")


def story(log):
    """What happens on the disk. Marks in the log say which version was current before and after each command."""
    def step(name, *words, may_fail=False):
        before = current()
        log.mark(f"begin:{before}")
        done = plumb_rt(*words)
        if done.returncode != 0 and not may_fail:
            raise SystemExit(f"{name}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
        log.mark(f"end:{current()}")
        print(f"       {name}: {before} -> {current()}", flush=True)

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


def entries():
    """(first byte, bytes of data, place of the data in the log, words of a mark) of each entry."""
    out = []
    with open(LOG, "rb") as log:
        magic, version, count, sector = struct.unpack("<QQQI", log.read(28))
        if (magic, version) != (0x6a736677736872, 1):
            raise SystemExit(f"this is no log of writes: {magic:x} {version}")
        at = sector
        for _ in range(count):
            log.seek(at)
            first, sectors, flags, length = struct.unpack("<QQQQ", log.read(32))
            mark = log.read(length).decode().rstrip("\0") if flags & MARK else None
            at += sector
            size = 0 if flags & (DISCARD | MARK) else sectors * sector
            out.append((first * sector, size, at, mark))
            at += size
    return out


def may_be_current(every):
    """For each entry the versions of which one must be current if the power fails behind it: during a command that
    before it or that after it, else the one that the last command left."""
    out, old = [], "None"
    ends = [mark[4:] for *_, mark in every if mark and mark.startswith("end:")]
    inside = False
    for *_, mark in every:
        if mark and mark.startswith("begin:"):
            inside = True
        elif mark and mark.startswith("end:"):
            inside, old = False, ends.pop(0)
        out.append({old, ends[0]} if inside else {old})
    return out


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


def cut_and_judge(every, chosen):
    """Makes the disk of each chosen number of entries, and judges it."""
    faults = 0
    allowed = may_be_current(every)
    with open(LOG, "rb") as log, open(IMAGE, "wb") as image:
        image.truncate(DISK_BYTES)
        for number, (first, size, at, _) in enumerate(every, 1):
            if size:
                log.seek(at)
                image.seek(first)
                image.write(log.read(size))
            if number not in chosen:
                continue
            image.flush()
            run("cp", "--sparse=always", IMAGE, WORK / "cut")
            loop = run("losetup", "--find", "--show", WORK / "cut")
            mounted = subprocess.run(["mount", loop, MOUNTED], capture_output=True, text=True)
            try:
                wrong = judged(allowed[number - 1]) if mounted.returncode == 0 else "no file system: " + mounted.stderr
            except OSError as error:
                wrong = str(error)
            if wrong:
                faults += 1
                print(f"{'found ' if PLANTED else 'FAILED'} cut after {number} writes: {wrong}", flush=True)
            subprocess.run(["umount", MOUNTED], capture_output=True)
            run("losetup", "--detach", loop)
    return faults


def main():
    with Log() as log:
        story(log)
    every = entries()
    MOUNTED.mkdir()
    # Not before the first file system is whole.
    marked = [n for n, (*_, mark) in enumerate(every, 1) if mark and mark.startswith(("begin:", "end:"))]
    begin, end = marked[0], marked[-1]
    chosen = set(random.Random(SEED).sample(range(begin, end + 1), min(CUTS, end + 1 - begin)))
    print(f"       {end + 1 - begin} writes, {len(chosen)} cuts, seed {SEED}", flush=True)
    faults = cut_and_judge(every, chosen)
    if PLANTED:
        print(f"{'ok    ' if faults else 'FAILED'} planted: without waiting for the disk {faults} of {len(chosen)} cuts leave a fault")
        return 0 if faults else 1
    print(f"{'ok    ' if faults == 0 else 'FAILED'} after {len(chosen)} cuts of the power one of the two models is there, whole, and runs;"
          f" {faults} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
