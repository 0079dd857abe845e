# SPDX-License-Identifier: Apache-2.0
"""What the programs print with --json: every verb, on several sample cells, in success and in failure."""
import json
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import time

CELLS = ("compliance", "scara", "mixed", "thermal")


class Printed:
    """One object that a program printed."""

    def __init__(self, words, code, text):
        self.words, self.code = words, code
        self.command = " ".join(words)
        self.json = json.loads(text)

    def schema_name(self):
        """ "fit" of plumb, "rt-status" of plumb-rt, "twin-run" of plumb-twin."""
        program, verb = self.json["schema"].split("/")[0].split(".")
        return program.replace("plumb-", "") + "-" + verb if program != "plumb" else verb


class Runner:
    """Runs the programs of one folder in a scratch folder and keeps what they print."""

    def __init__(self, programs, scratch):
        self.programs, self.scratch, self.printed = pathlib.Path(programs), pathlib.Path(scratch), []

    def start(self, *words, **how):
        words = [str(word) for word in words]
        return subprocess.Popen([str(self.programs / words[0]), *words[1:], "--json"], cwd=self.scratch,
                                stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **how)

    def finish(self, process, *words):
        out, err = process.communicate(timeout=600)
        try:
            self.printed.append(Printed([str(word) for word in words], process.returncode, out))
        except json.JSONDecodeError as error:
            raise SystemExit(f"{' '.join(map(str, words))} --json prints no JSON object: {error}\n{out}\n{err}")
        return self.printed[-1]

    def run(self, *words):
        return self.finish(self.start(*words), *words)

    def write(self, name, text):
        path = self.scratch / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path


def few_readings(plumb, cell):
    """few.csv: every twentieth measurement; moved.csv: the same half a millimetre along x."""
    few, moved, rows, at = [], [], 0, None
    for line in (plumb.scratch / cell / "measurements.csv").read_text().splitlines():
        cells = line.split(",")
        if line.startswith("#") or at is None:
            at = cells.index("x_mm") if "x_mm" in cells else at
        else:
            rows += 1
            if rows % 20:
                continue
            cells[at] = str(float(cells[at]) + 0.5)
        few.append(line)
        moved.append(",".join(cells))
    plumb.write(f"{cell}/few.csv", "\n".join(few) + "\n")
    plumb.write(f"{cell}/moved.csv", "\n".join(moved) + "\n")


def in_cell(plumb, cell):
    """Every verb that works in a cell, before and after an effect was added."""
    at = ("plumb", "-C", cell)
    plumb.run("plumb", "demo", cell, cell)
    plumb.run(*at, "check")
    plumb.run(*at, "fit", "--dry-run")
    plumb.run(*at, "fit")
    plumb.run(*at, "compare")
    plumb.run(*at, "diagnose")
    plumb.run(*at, "plan", "--n", "6", "-o", f"{cell}/plan.csv")
    plumb.run(*at, "plan", "--recheck", "-o", f"{cell}/again.csv")
    few_readings(plumb, cell)
    plumb.run(*at, "recheck", "--data", f"{cell}/few.csv")
    plumb.run(*at, "recheck", "--data", f"{cell}/moved.csv", "--new-target", "--dry-run")
    plumb.run(*at, "recheck", "--data", f"{cell}/moved.csv")
    plumb.run(*at, "recheck", "--data", f"{cell}/measurements.csv")                # 3: the calibration itself
    plumb.run(*at, "compile")
    plumb.run(*at, "compile", "--refit-all", "-o", f"{cell}/all.plumb")
    plumb.run(*at, "export", "-o", f"{cell}/arm.urdf")
    plumb.run(*at, "export", "--nominal", "-o", f"{cell}/nominal.urdf")
    plumb.run(*at, "deploy", "-o", f"{cell}/deploy")
    plumb.run(*at, "dbc")
    plumb.run(*at, "dbc", "-o", f"{cell}/bus.dbc")
    plumb.run(*at, "modbus-map")
    plumb.run(*at, "modbus-map", "--csv", "-o", f"{cell}/map.csv")
    plumb.run(*at, "predict", "--as-measured", "-o", f"{cell}/as_measured.csv")
    plumb.run("plumb", "inspect", f"{cell}/robot.plumb")
    plumb.run("plumb", "predict", f"{cell}/robot.plumb", "--data", f"{cell}/measurements.csv", "-o", f"{cell}/p.csv")
    plumb.run("plumb", "correct", f"{cell}/robot.plumb", "--data", f"{cell}/targets.csv", "-o", f"{cell}/c.csv")
    corpus = pathlib.Path(__file__).resolve().parents[1] / "programs/corpus"
    for program in (corpus / "traps.mod", corpus / "traps.script"):  # of the second none: where are the joints?
        plumb.run(*at, "filter", str(program), "-o", f"{cell}/filtered")
        plumb.run(*at, "filter", str(program), "-o", f"{cell}/filtered", "--dry-run", "--force")
    plumb.run("plumb", "bench", f"{cell}/robot.plumb", "--calls", "200")
    plumb.run(*at, "diagnose", "--apply", "--dry-run")
    plumb.run(*at, "diagnose", "--apply")
    plumb.run(*at, "add", "gear_harmonics", "--joints", "J1", "--dry-run")
    plumb.run(*at, "add", "gear_harmonics", "--joints", "J1")
    plumb.run(*at, "drop", "gear_harmonics", "--joints", "J1")
    plumb.run(*at, "runs")
    plumb.run(*at, "plot", "error-hist", "-o", f"{cell}/hist.svg")
    plumb.run(*at, "plot", "joint-J1", "-o", f"{cell}/joint.svg", "--dry-run")
    plumb.run(*at, "report", "-o", f"{cell}/report.html")
    plumb.run(*at, "report", "-o", f"{cell}/first.html", "--run", "1", "--dry-run")
    plumb.run(*at, "diff", "1", "2")
    plumb.run(*at, "compare", "1", "2")
    plumb.run(*at, "compile", "--force")
    plumb.run("plumb", "inspect", f"{cell}/robot.plumb")


def a_fleet(plumb):
    """Five arms, a copy of one, and a cell that cannot be read."""
    for seed in range(1, 6):
        cell = f"fleet/arm{seed}"
        plumb.run("plumb", "demo", "gear", cell)
        plumb.run("plumb", "-C", cell, "simulate", "--poses", "60", "--seed", str(seed), "--force")
    shutil.copytree(plumb.scratch / "fleet/arm1", plumb.scratch / "fleet/copy")
    (plumb.scratch / "fleet/broken").mkdir()
    plumb.write("fleet/broken/cell.toml", "schema = \n")
    plumb.run("plumb", "fleet", "fleet")
    plumb.run("plumb", "fleet", "fleet", "--diagnose")
    plumb.run("plumb", "fleet", "fleet", "--share", "0/2")
    plumb.run("plumb", "fleet", "fleet/broken")                                     # 3: no cell in it


def other_forms(plumb):
    """Forms of a verb that no sample cell needs."""
    plumb.run("plumb", "demo", "--list")
    plumb.run("plumb", "explain")
    plumb.run("plumb", "explain", "E-CSV-UNIT")
    plumb.run("plumb", "explain", "joint_compliance")
    plumb.run("plumb", "simulate", "--list")
    plumb.run("plumb", "plot", "--list")
    dh = plumb.write("dh.csv", "joint,alpha_deg,a_mm,d_mm,theta_deg\nJ1,0,400,0,0\nJ2,0,300,0,0\n")
    plumb.run("plumb", "new", "arm", "--dh", dh, "--convention", "standard", "--dry-run")
    plumb.run("plumb", "new", "arm", "--dh", dh, "--convention", "standard")
    plumb.run("plumb", "-C", "arm", "simulate", "--poses", "60", "--hidden", "gear_harmonics:J1", "--dry-run")
    plumb.run("plumb", "-C", "arm", "simulate", "--poses", "60", "--hidden", "gear_harmonics:J1")
    plumb.run("plumb", "-C", "arm", "check", "--fix")
    plumb.run("plumb", "-C", "arm", "fit", "--held-out", "kfold:5")
    plumb.run("plumb", "-C", "arm", "add", "local_tree", "--dry-run")
    plumb.run("plumb", "-C", "arm", "add", "formula", "--formula", "dq1 = k * sin(q1)", "--parameter", "k [rad] ~ 1e-4")
    plumb.run("plumb", "-C", "arm", "compile")
    plumb.run("plumb", "inspect", "arm/robot.plumb")
    plumb.run("plumb", "-C", "compliance", "plan", "--n", "4", "--separate", "joint_compliance:J2,gravity_free:J2",
              "-o", "separate.csv")
    plumb.run("plumb", "-C", "arm", "plan", "--n", "4", "-o", "first.csv")
    text = "name,q1_deg,q2_deg,x_mm,y_mm,z_mm\nA,0,0,700,0,0\nB,90,0,0,700,0\nC,0,90,400,300,0\n"
    tracker = plumb.write("tracker.txt", text)
    plumb.run("plumb", "import", tracker, "--preview")
    plumb.run("plumb", "import", tracker, "-o", "imported.csv")
    plumb.run("plumb", "study", "six-axis", "--draws", "1")
    plumb.run("plumb", "study", "planar", "--write-cell", "study")
    plumb.run("plumb", "study", "planar", "--without-finest")
    other_measurements(plumb)
    # Units that contradict the arm, so that check has something to repair and fit something to complain of.
    plumb.run("plumb", "demo", "clean", "wrong")
    cell = plumb.scratch / "wrong/measurements.csv"
    cell.write_text(cell.read_text().replace("x_mm,y_mm,z_mm", "x_m,y_m,z_m"))
    plumb.run("plumb", "-C", "wrong", "check")
    plumb.run("plumb", "-C", "wrong", "check", "--fix", "--dry-run")
    # Without repeats and without sigma_um there is no noise floor.
    plumb.run("plumb", "demo", "clean", "floorless")
    toml = plumb.scratch / "floorless/cell.toml"
    toml.write_text(re.sub(r"(?m)^sigma_um.*$", "", toml.read_text()))
    table = plumb.scratch / "floorless/measurements.csv"
    lines = table.read_text().splitlines(keepends=True)
    head = next(i for i, line in enumerate(lines) if not line.startswith("#"))
    names = lines[head].strip().split(",")
    seen, kept = set(), lines[:head + 1]
    for line in lines[head + 1:]:
        pose = line.split(",")[names.index("pose")]
        if pose not in seen:
            kept.append(line)
            seen.add(pose)
    table.write_text("".join(kept))
    for verb in ("check", "fit", "compare", "diagnose"):
        plumb.run("plumb", "-C", "floorless", verb)


def other_measurements(plumb):
    """Orientations, several set-ups, jumps, structure that no effect explains, a tree, and readings of one joint side."""
    plumb.run("plumb", "-C", "arm", "simulate", "--poses", "80", "--force")
    for cell in ("bumped", "unknown", "reversal"):
        plumb.run("plumb", "demo", cell, cell)
        for verb in ("fit", "compare", "diagnose"):
            plumb.run("plumb", "-C", cell, verb)
    at = ("plumb", "-C", "study")
    plumb.run(*at, "add", "local_tree")
    plumb.run(*at, "fit", "--dry-run")
    plumb.run(*at, "compile")
    plumb.run("plumb", "inspect", "study/robot.plumb")
    plumb.run("plumb", "bench", "study/robot.plumb", "--calls", "200", "-o", "latency.svg")
    plumb.run("plumb", "demo", "clean", "turning")
    plumb.run("plumb", "-C", "turning", "simulate", "--poses", "80", "--noise-urad", "20", "--force")
    plumb.run("plumb", "-C", "turning", "check")
    plumb.run("plumb", "-C", "turning", "fit")
    plumb.run("plumb", "-C", "turning", "compare")
    two_set_ups(plumb)
    wrong = (plumb.scratch / "compliance/targets.csv").read_text().splitlines()
    far = [line if line.startswith("#") or "x_mm" in line else ",".join(["9000", *line.split(",")[1:]]) for line in wrong]
    plumb.write("far.csv", "\n".join(far) + "\n")
    plumb.run("plumb", "correct", "compliance/robot.plumb", "--data", "far.csv", "-o", "far_out.csv")


def two_set_ups(plumb):
    plumb.run("plumb", "demo", "clean", "days")
    table = plumb.scratch / "days/measurements.csv"
    lines = table.read_text().splitlines()
    head = next(i for i, line in enumerate(lines) if not line.startswith("#"))
    middle = (head + len(lines)) // 2
    for name, rows in (("day1.csv", lines[head + 1:middle]), ("day2.csv", lines[middle:])):
        plumb.write(f"days/{name}", "\n".join([lines[head], *rows]) + "\n")
    toml = plumb.scratch / "days/cell.toml"
    text = re.sub(r"(?m)^(files|frame|target) *=.*\n", "", toml.read_text())
    toml.write_text(text + '\n[[measurement.setup]]\nname = "day 1"\nfiles = ["day1.csv"]\n'
                    '\n[[measurement.setup]]\nname = "day 2"\nfiles = ["day2.csv"]\n')
    plumb.run("plumb", "-C", "days", "fit")
    plumb.run("plumb", "-C", "days", "compare")


def failures(plumb):
    """What is printed when a verb cannot go on: every exit code but those of a bug, an interrupt and a lost bus."""
    plumb.run("plumb", "-C", "compliance", "fit", "--max-rms", "0.000001")        # 1
    plumb.run("plumb", "-C", "compliance", "compile", "--gate", "--force")        # 0 or 1
    plumb.run("plumb", "bench", "compliance/robot.plumb", "--calls", "100", "--max-us", "0.0001")  # 1
    plumb.run("plumb")                                                            # 2: no verb
    plumb.run("plumb", "fitt")                                                    # 2: no such verb
    plumb.run("plumb", "fit", "--sed", "3")                                       # 2: no such option
    plumb.run("plumb", "-C", "compliance", "predict", "--as-measured")            # 2: --json needs -o
    plumb.run("plumb", "-C", "compliance", "plot", "error-hits", "-o", "hits.svg")  # 2: no such figure
    plumb.run("plumb", "-C", "nowhere", "fit")
    plumb.write("broken/cell.toml", "schema = \"cell/1\"\n[robot]\ndh_convention = \"modifed\"\n")
    for verb in ("check", "fit", "compare", "diagnose", "compile", "runs"):
        plumb.run("plumb", "-C", "broken", verb)                                  # 3
    plumb.run("plumb", "inspect", "compliance/measurements.csv")                  # 3
    plumb.run("plumb", "explain", "no_such_word")
    few = plumb.write("few/measurements.csv", "pose,q1_deg,q2_deg,x_mm,y_mm\n1,0,0,700,0\n2,90,0,0,700\n")
    few.with_name("cell.toml").write_text((plumb.scratch / "arm/cell.toml").read_text())
    for verb in ("check", "fit", "diagnose"):
        plumb.run("plumb", "-C", "few", verb)                                     # 4
    plumb.run("plumb", "-C", "compliance", "export", "-o", "/proc/nowhere/arm.urdf")  # 5
    plumb.run("plumb-rt", "status", "compliance")                                 # nothing runs there
    plumb.run("plumb-rt", "run", "compliance")
    plumb.run("plumb-rt", "doctor", "--strict")
    plumb.run("plumb-twin", "run", "nowhere")


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def installed(plumb):
    """A place with two versions, on a machine that demands signatures."""
    etc = plumb.scratch / "twin/etc"
    (etc / "keys.d").mkdir(parents=True, mode=0o755)
    for folder in (etc, etc / "keys.d"):
        folder.chmod(0o755)
    here = ("--to", "./twin/place", "--etc", etc)
    plumb.run("plumb-rt", "install", "twin/signed", *here)                        # 3: a key that nobody trusts
    shutil.copy(plumb.scratch / "twin/anna.pub", etc / "keys.d/anna.pub")
    (etc / "keys.d/anna.pub").chmod(0o644)
    plumb.run("plumb-rt", "install", "twin/signed", *here)
    toml = plumb.scratch / "twin/signed/rt.toml"
    toml.write_text(toml.read_text().replace("target_step_mm = 50", "target_step_mm = 40"))
    plumb.run("plumb-rt", "seal", "twin/signed", "--sign", "twin/anna.key")
    plumb.run("plumb-rt", "install", "twin/signed", *here)
    plumb.run("plumb-rt", "rollback", *here)
    plumb.run("plumb-rt", "rollback", *here)                                      # 3: there is none before
    plumb.run("plumb-rt", "list", *here[:2])
    plumb.run("plumb-rt", "verify", *here)
    (etc / "keys.d/anna.pub").rename(etc / "keys.d/anna.revoked")
    plumb.run("plumb-rt", "verify", *here)                                        # 3


def controller_side(plumb):
    """plumb-twin as Modbus server, and plumb-rt as its client."""
    plumb.run("plumb-rt", "doctor", "--fix", "--dry-run")
    plumb.run("plumb-twin", "new", "twin", "--dry-run")
    plumb.run("plumb-twin", "new", "twin")
    plumb.run("plumb-twin", "measure", "twin")
    plumb.run("plumb-twin", "measure", "twin", "--sister", "2", "--change", "tool=0.2mm", "-o", "sister/measurements.csv")
    plumb.run("plumb-twin", "run", "twin", "--correction", "off", "--stations", "3")
    plumb.run("plumb-twin", "run", "--list-faults")
    plumb.run("plumb", "keygen", "twin/anna")
    plumb.run("plumb", "keygen", "twin/anna")                                     # 2: never replaced
    plumb.run("plumb", "-C", "twin", "deploy", "-o", "twin/signed", "--sign", "twin/anna.key")
    installed(plumb)
    plumb.run("plumb", "-C", "twin", "deploy", "-o", "twin/deploy")
    toml = plumb.scratch / "twin/deploy/rt.toml"
    port = free_port()
    text = toml.read_text().replace('kind = "can"\ninterface = "vcan0"', f'kind = "modbus"\nport = {port}')
    text = text.replace('mode = "shadow"', 'mode = "full"')
    toml.write_text(text.replace('# record = "record.log"', 'record = "record.log"'))
    plumb.run("plumb-rt", "seal", "twin/deploy")
    plumb.run("plumb-rt", "run", "twin/deploy", "--priority", "0", "--check")
    words = ("plumb-rt", "run", "twin/deploy", "--priority", "0")
    daemon = plumb.start(*words)
    drive = ("plumb-twin", "run", "twin", "--modbus-serve", f"127.0.0.1:{port}", "--stations", "10", "--wait-s", "20")
    twin = plumb.start(*drive)
    try:
        for _ in range(100):
            time.sleep(0.1)
            probe = subprocess.run([str(plumb.programs / "plumb-rt"), "status", "twin/deploy"], cwd=plumb.scratch,
                                   capture_output=True, check=False)
            if probe.returncode == 0:
                break
        plumb.run("plumb-rt", "status", "twin/deploy")
        plumb.run("plumb-rt", "monitor", "twin/deploy", "--once")
        plumb.run("plumb-rt", "swap", "twin/deploy/robot.plumb", "--dir", "twin/deploy")
        plumb.finish(twin, *drive)
    finally:
        daemon.send_signal(signal.SIGTERM)
        plumb.finish(daemon, *words)
    plumb.run("plumb-rt", "events", "twin/deploy")
    record = next(iter((plumb.scratch / "twin/deploy").glob("record*")), None)
    if record:
        plumb.run("plumb-rt", "replay", record, "--dir", "twin/deploy")


def everything(programs, scratch):
    os.environ["NO_COLOR"] = "1"
    plumb = Runner(programs, scratch)
    for cell in CELLS:
        in_cell(plumb, cell)
    other_forms(plumb)
    a_fleet(plumb)
    controller_side(plumb)
    failures(plumb)
    return plumb.printed
