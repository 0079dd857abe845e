# SPDX-License-Identifier: Apache-2.0
"""Inside the emulated machine: a small disk whose every write is logged while a story happens on it, and the same disk
made anew as a cut of the power would have left it at any of these writes.

The kernel's target log-writes keeps each write in the order in which it ended, and with it what was flushed; what was
still in memory is not in the log. So a disk made of the first n entries is one that a cut may leave. Its format:
Documentation/admin-guide/device-mapper/log-writes.rst of the kernel."""
import pathlib
import random
import struct
import subprocess

WORK = pathlib.Path("/run/cut")
AT, MOUNTED = WORK / "at", WORK / "mounted"  # the logged disk; the disk after a cut
DISK, LOG, IMAGE = WORK / "disk", WORK / "log", WORK / "image"
LOG_BYTES = 600 << 20
DISCARD, MARK = 4, 8


def run(*command, **options):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, **options)
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(map(str, command))}: {done.stdout}{done.stderr}")
    return done.stdout.strip()


class LoggedDisk:
    """Mounted at AT as long as the with-block lasts. `options` are those of mount, now and after a cut."""

    def __init__(self, megabytes, options="commit=1"):
        self.bytes, self.options = megabytes << 20, options

    def __enter__(self):
        WORK.mkdir()
        AT.mkdir()
        loops = []
        for file, size in ((DISK, self.bytes), (LOG, LOG_BYTES)):
            with open(file, "wb") as out:
                out.truncate(size)
            loops.append(run("losetup", "--find", "--show", file))
        table = f"0 {self.bytes // 512} log-writes {loops[0]} {loops[1]}"
        run("dmsetup", "--noudevsync", "create", "cut", "--table", table)
        run("dmsetup", "mknodes")
        run("mkfs.ext4", "-q", "-J", "size=4", "/dev/mapper/cut")
        run("mount", "-o", self.options, "/dev/mapper/cut", AT)
        run("sync")
        return self

    def __exit__(self, *_):
        run("umount", AT)
        run("dmsetup", "--noudevsync", "remove", "cut")
        run("losetup", "--detach-all")

    def step(self, name, state, action):
        """Marks in the log say what `state()` was before and after the action."""
        before = state()
        self._mark(f"begin:{before}")
        action()
        self._mark(f"end:{state()}")
        print(f"       {name}: {before} -> {state()}", flush=True)

    def _mark(self, words):
        run("dmsetup", "--noudevsync", "message", "cut", "0", "mark", words)

    def faults_of_cuts(self, count, seed, judged, found="FAILED"):
        """Makes the disk of `count` random numbers of entries, mounts it at MOUNTED, and asks `judged(allowed)` what is
        wrong with it; `allowed`: the states of which one must be there. Returns how many are wrong, and of how many."""
        every = entries()
        allowed = may_be_there(every)
        MOUNTED.mkdir()
        # Not before the first file system is whole.
        marked = [n for n, (*_, mark) in enumerate(every, 1)
                  if mark and mark.startswith(("begin:", "end:"))]
        begin, end = marked[0], marked[-1]
        chosen = set(random.Random(seed).sample(range(begin, end + 1), min(count, end + 1 - begin)))
        print(f"       {end + 1 - begin} writes, {len(chosen)} cuts, seed {seed}", flush=True)
        faults = 0
        with open(LOG, "rb") as log, open(IMAGE, "wb") as image:
            image.truncate(self.bytes)
            for number, (first, size, at, _) in enumerate(every, 1):
                if size:
                    log.seek(at)
                    image.seek(first)
                    image.write(log.read(size))
                if number not in chosen:
                    continue
                image.flush()
                wrong = self._after_a_cut(lambda: judged(allowed[number - 1]))
                if wrong:
                    faults += 1
                    print(f"{found} cut after {number} writes: {wrong}", flush=True)
        return faults, len(chosen)

    def _after_a_cut(self, judged):
        run("cp", "--sparse=always", IMAGE, WORK / "cut")
        loop = run("losetup", "--find", "--show", WORK / "cut")
        mounted = subprocess.run(["mount", "-o", self.options, loop, MOUNTED],
                                 capture_output=True, text=True)
        try:
            return judged() if mounted.returncode == 0 else "no file system: " + mounted.stderr
        except OSError as error:
            return str(error)
        finally:
            subprocess.run(["umount", MOUNTED], capture_output=True)
            run("losetup", "--detach", loop)


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


def may_be_there(every):
    """For each entry the states of which one must be there if the power fails behind it: during a step that before it or
    that after it, else the one that the last step left."""
    out, old = [], None
    ends = [mark[4:] for *_, mark in every if mark and mark.startswith("end:")]
    inside = False
    for *_, mark in every:
        if mark and mark.startswith("begin:"):
            inside, old = True, mark[6:]
        elif mark and mark.startswith("end:"):
            inside, old = False, ends.pop(0)
        out.append({old, ends[0]} if inside else {old})
    return out
