#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Inside the emulated machine: the power fails while the Debian package plumb-rt is upgraded, downgraded and upgraded
again, with and without a service that runs, in a small root on a logged disk (logged_disk.py). After each cut a model
and the program must be there, whole; dpkg must be able to read its database; and REPAIR must bring the newer version.

  power_cut_upgrade.py OLDER.deb NEWER.deb STATUS FOLDERS CUTS SEED [LIBRARY]

STATUS: entries of dpkg's database for the packages that plumb-rt asks for. FOLDERS: as for power_cut.py, `a`, `run` and
`run2`, and `etc/keys.d`. LIBRARY is loaded into dpkg while it installs: a planted fault, which must be found both in the
program and in dpkg's database. --force-unsafe-io would be none: dpkg then does not wait for the files of a package, but
starts writing them as it unpacks, and ext4 has written them when it writes the names that they get.

The disk is mounted with noauto_da_alloc, so that ext4 does not wait of itself for a file that replaces another: dpkg has
to.

The maintainer scripts run with DPKG_ROOT, which they are made for, and with the programs of this machine: a root in
which they could run by themselves would be a whole Debian on the logged disk."""
import collections
import hashlib
import io
import itertools
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tarfile
import time

from logged_disk import AT, MOUNTED, WORK, LoggedDisk, run

OLDER, NEWER, STATUS, FOLDERS = (pathlib.Path(word) for word in sys.argv[1:5])
CUTS, SEED = int(sys.argv[5]), int(sys.argv[6])
PLANTED = sys.argv[7] if len(sys.argv) > 7 else ""
PROGRAM, PLACE, KEYS, DATABASE = "usr/bin/plumb-rt", "var/lib/plumb/cell", "etc/plumb", "var/lib/dpkg"
VARIANTS = ("baseline", "x86-64-v3")
REPAIR = ("--install", NEWER)  # as docs/operate.md says it


def contents(deb):
    """What is in the package, by its name: (SHA-256, mode) of a file, (where it leads, 0) of a link."""
    tree = subprocess.run(["dpkg-deb", "--fsys-tarfile", deb], capture_output=True, check=True).stdout
    with tarfile.open(fileobj=io.BytesIO(tree)) as members:
        return {one.name.removeprefix("./"): (one.linkname, 0) if one.issym() else
                (hashlib.sha256(members.extractfile(one).read()).hexdigest(), one.mode)
                for one in members if not one.isdir()}


def version(deb):
    return run("dpkg-deb", "-f", deb, "Version")


PACKAGES = {version(deb): contents(deb) for deb in (OLDER, NEWER)}
NEW = version(NEWER)


def quietly(*command, **options):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, **options)


def dpkg(root, *words, planted=""):
    """This machine's own force-unsafe-io counts for nothing: the settings of containers often have it."""
    options = [f"--root={root}", f"--log={root}/var/log/dpkg.log", "--no-force-unsafe-io",
               "--force-script-chrootless"]
    settings = {**os.environ, "LC_ALL": "C", "LD_PRELOAD": planted}
    return quietly("dpkg", *options, *words, env=settings)


def database_says(root):
    """State and version of plumb-rt, such as "install ok installed 0.1.0-1"."""
    return run("dpkg-query", f"--admindir={root / DATABASE}", "-W", "-f", "${Status} ${Version}",
               "plumb-rt")


def plumb_rt(root, *words, variant=None):
    rules = ["--etc", root / KEYS] if words[0] != "status" else []
    settings = {**os.environ, **({"PLUMB_RT_VARIANT": variant} if variant else {})}
    return quietly(root / PROGRAM, *words, *rules, env=settings)


def current(root):
    link = root / PLACE / "current"
    return os.readlink(link) if link.is_symlink() else None


def went_well(what, done):
    if done.returncode != 0:
        raise SystemExit(f"{what}: exit code {done.returncode}\n{done.stdout}{done.stderr}")


def prepared(root):
    """A root in which the older package is installed and a model is current."""
    for folder in ("info", "updates", "triggers", "parts"):
        (root / DATABASE / folder).mkdir(parents=True)
    (root / "var/log").mkdir()
    (root / "etc").mkdir()
    (root / "etc/passwd").write_text("root:x:0:0:root:/root:/bin/sh\n")
    (root / "etc/group").write_text("root:x:0:\n")
    shutil.copy(STATUS, root / DATABASE / "status")
    (root / DATABASE / "available").touch()
    for entry in STATUS.read_text().split("\n\n"):
        fields = dict(line.split(": ", 1) for line in entry.splitlines()
                      if line[:1].isalpha() and ": " in line)
        if "Package" in fields:
            of_several = f":{fields['Architecture']}" if fields.get("Multi-Arch") == "same" else ""
            name = root / DATABASE / f"info/{fields['Package']}{of_several}"
            pathlib.Path(f"{name}.list").write_text("/.\n")
            pathlib.Path(f"{name}.md5sums").touch()
    went_well("the older package", dpkg(root, "--install", OLDER))
    for key in (FOLDERS / "etc/keys.d").iterdir():
        run("install", "-m", "644", key, root / KEYS / "keys.d")
    went_well("a model", plumb_rt(root, "install", FOLDERS / "a", "--to", root / PLACE))
    run("sync")


def story(disk, root):
    """Its state is the model that is current, and the version of the package."""
    def state():
        return f"{current(root)}|{database_says(root).split()[-1]}"

    def step(name, action):
        disk.step(name, state, lambda: went_well(name, action()))

    def package(name, deb):
        step(name, lambda: dpkg(root, "--install", deb, planted=PLANTED))

    def model(name, folder):
        step(name, lambda: plumb_rt(root, "install", FOLDERS / folder, "--to", root / PLACE))

    package("upgrade", NEWER)
    model("a model by the new program", "run")
    package("downgrade", OLDER)
    if PLANTED:
        return
    with Service(root) as service:
        package("upgrade beside a service", NEWER)
        service.must_run()
        model("a model by the new program for the old one that runs", "run2")
        time.sleep(2)
        service.must_run()
    with Service(root) as service:
        package("downgrade beside a service", OLDER)
        service.must_run()
        package("upgrade again beside a service", NEWER)
        time.sleep(2)
        service.must_run()


class Service:
    """plumb-rt runs the place from that root and writes a record there."""

    def __init__(self, root):
        self.root = root

    def __enter__(self):
        (WORK / "corrected.csv").unlink(missing_ok=True)  # one that is there is never replaced
        self.said = open(WORK / "rt.log", "w")
        command = [self.root / PROGRAM, "run", self.root / PLACE, "--priority", "0", "--etc", self.root / KEYS]
        self.process = subprocess.Popen(command, stdout=self.said, stderr=self.said)
        until = time.monotonic() + 60
        while not self.answers() and self.process.poll() is None and time.monotonic() < until:
            time.sleep(0.5)
        self.must_run()
        time.sleep(2)
        return self

    def answers(self):
        return plumb_rt(self.root, "status", self.root / PLACE).returncode == 0

    def must_run(self):
        if self.process.poll() is not None or not self.answers():
            raise SystemExit("it does not run:\n" + (WORK / "rt.log").read_text())

    def __exit__(self, *_):
        self.process.send_signal(signal.SIGTERM)
        self.process.wait(60)
        self.said.close()


def state_of(file):
    """As contents() has it; None if there is none."""
    if file.is_symlink():
        return os.readlink(file), 0
    if not file.is_file():
        return None
    return hashlib.sha256(file.read_bytes()).hexdigest(), file.stat().st_mode & 0o7777


def files_differ(root, versions):
    """Kind and words of a fault: each file must be that of one of these versions, as a whole. A name that one of them
    lacks may be missing."""
    for name in sorted(set(itertools.chain(*PACKAGES.values()))):
        found = state_of(root / name)
        if found in [PACKAGES[one].get(name) for one in versions]:
            continue
        others = [one for one, files in PACKAGES.items() if files.get(name) == found]
        if others:
            words = f"{name} is that of {others[0]}, not of {' or '.join(versions)}"
            return {"program of another version": words}
        size = f"{(root / name).lstat().st_size} bytes, mode {found[1]:o}" if found else "missing"
        return {"broken program": f"{name} is that of no version: {size}"}
    return {}


def model_fails(root, variants):
    done = plumb_rt(root, "verify", "--to", root / PLACE)
    if done.returncode != 0:
        return f"verify: {done.stdout}{done.stderr}"
    for variant in variants:
        (WORK / "corrected.csv").unlink(missing_ok=True)
        done = plumb_rt(root, "run", root / PLACE, "--check", "--priority", "0", variant=variant)
        if done.returncode != 0:
            return f"run --check, {variant}: {done.stdout}{done.stderr}"
    return ""


def left_behind(root):
    """Files in the folders of the package that are none of the newer one."""
    there = {str(file.relative_to(root)) for file in (root / "usr").rglob("*")
             if file.is_symlink() or not file.is_dir()}
    return ", ".join(sorted(there - set(PACKAGES[NEW])))


def repair_fails(root):
    done = dpkg(root, *REPAIR)
    if done.returncode != 0:
        return f"dpkg {' '.join(map(str, REPAIR))}: {done.stdout}{done.stderr}"
    if database_says(root) != f"install ok installed {NEW}":
        return f"after the repair dpkg says: {database_says(root)}"
    for words in (("--audit",), ("--verify", "plumb-rt")):
        done = dpkg(root, *words)
        if done.returncode != 0 or done.stdout:
            return f"after the repair dpkg {' '.join(words)} says: {done.stdout}{done.stderr}"
    files = left_behind(root)
    return f"left behind: {files}" if files else "".join(files_differ(root, [NEW]).values())


class Judge:
    """Says what is wrong with the mounted disk; counts the faults by kind, and what dpkg says of the package."""

    def __init__(self):
        self.faults, self.said, self.configured = (collections.Counter() for _ in range(3))

    def __call__(self, allowed):
        root = MOUNTED / "root"
        models, versions = (sorted(set(words)) for words in zip(*(state.split("|") for state in allowed)))
        now = str(current(root))
        found = {"model": "" if now in models else f"current is {now}, not {' or '.join(models)}",
                 "database": self.database_fails(root, versions), **files_differ(root, versions)}
        if not any(found.values()):
            found = {"run": model_fails(root, VARIANTS)}
        if not any(found.values()):
            found = {"repair": self.repair_fails_after_all(root)}
        wrong = {kind: words for kind, words in found.items() if words}
        self.faults.update(wrong.keys())
        return "; ".join(f"{kind}: {words.strip()}" for kind, words in wrong.items())

    def database_fails(self, root, versions):
        try:
            state, _, version_there = database_says(root).rpartition(" ")
        except SystemExit as error:
            return str(error)
        self.said[state] += 1
        if version_there in versions and (len(versions) > 1 or state == "install ok installed"):
            return ""
        return f"dpkg says {state} {version_there}, not {' or '.join(versions)}"

    def repair_fails_after_all(self, root):
        """apt asks for --configure -a first. That need not be enough, and must not be in the way of the repair."""
        if self.said.total() % 2 == 0 and not database_says(root).startswith("install ok installed"):
            done = dpkg(root, "--configure", "-a")
            self.configured[f"exit code {done.returncode}, {database_says(root).rpartition(' ')[0]}"] += 1
        return repair_fails(root) or model_fails(root, VARIANTS[-1:])


def main():
    with LoggedDisk(128, "commit=1,noauto_da_alloc") as disk:
        root = AT / "root"
        prepared(root)
        story(disk, root)
    judge = Judge()
    faults, cuts = disk.faults_of_cuts(CUTS, SEED, judge, "found " if PLANTED else "FAILED")
    if PLANTED:
        both = judge.faults["broken program"] > 0 and judge.faults["database"] > 0
        print(f"{'ok    ' if both else 'FAILED'} planted: where dpkg does not wait for the disk {faults} of"
              f" {cuts} cuts leave a fault: {listed(judge.faults)}")
        return 0 if both else 1
    print(f"       after the cut dpkg says: {listed(judge.said)}")
    print(f"       --configure -a, tried in half of those not installed, leaves: {listed(judge.configured)}")
    print(f"{'ok    ' if faults == 0 else 'FAILED'} after {cuts} cuts of the power in an upgrade the model and"
          f" one of the two programs are there, whole, and dpkg {REPAIR[0]} ends in the newer one; {faults} faults")
    return 1 if faults else 0


def listed(counts):
    return "; ".join(f"{words} {times}" for words, times in counts.most_common())


if __name__ == "__main__":
    sys.exit(main())
