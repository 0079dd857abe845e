# SPDX-License-Identifier: Apache-2.0
"""Arms, cells and tables of the blind studies: kinematics and gravity that share no code with Plumb."""
import csv
import json
import math
import subprocess

# ---------------------------------------------------------------------- vectors and frames, mm and rad


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def times(s, a):
    return (s * a[0], s * a[1], s * a[2])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def norm(a):
    return math.sqrt(dot(a, a))


def unit(a):
    return times(1.0 / norm(a), a)


def turned(rows, v):
    return (dot(rows[0], v), dot(rows[1], v), dot(rows[2], v))


def product(a, b):
    columns = tuple(zip(*b))
    return tuple(tuple(dot(row, column) for column in columns) for row in a)


def column(rows, k):
    return (rows[0][k], rows[1][k], rows[2][k])


def rotation(v):
    """About v by |v|: the formula of Rodrigues."""
    angle = norm(v)
    if angle < 1e-15:
        return ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    x, y, z = unit(v)
    c, s = math.cos(angle), math.sin(angle)
    t = 1.0 - c
    return ((t * x * x + c, t * x * y - s * z, t * x * z + s * y),
            (t * x * y + s * z, t * y * y + c, t * y * z - s * x),
            (t * x * z - s * y, t * y * z + s * x, t * z * z + c))


def after(first, second):
    """The frame `second`, given in `first`."""
    return product(first[0], second[0]), add(first[1], turned(first[0], second[1]))


def direction(rng):
    return unit((rng.gauss(0, 1), rng.gauss(0, 1), rng.gauss(0, 1)))


X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
HERE = (rotation((0.0, 0.0, 0.0)), (0.0, 0.0, 0.0))


def about(axis, angle, along, distance):
    return rotation(times(angle, axis)), times(distance, along)


# -------------------------------------------------------------------------------- arms and their cells


class Kind:
    """An arm of a catalogue. rows: alpha, a, d, theta (deg, mm); links: joint, kg, centre in the
    frame behind the row [mm]; springs: joint, rad/(N m); play: joints whose play the cell lists."""

    def __init__(self, name, convention, rows, limits, links, springs, play, tool, payload, parallel):
        self.name, self.convention, self.limits, self.links = name, convention, limits, links
        self.rows = [(math.radians(r[0]), r[1], r[2], math.radians(r[3])) for r in rows]
        self.springs, self.play, self.tool, self.payload = springs, play, tool, payload
        self.parallel = parallel

    def joints(self):
        return len(self.rows)


def text(value):
    return f"{value:.10g}"


def cell_text(kind, name, sigma_um, effects, serial="", fit=()):
    """effects: lines that follow [effects]; fit: lines of [fit]."""
    joints = []
    for k, (alpha, a, d, theta) in enumerate(kind.rows):
        low, high = kind.limits[k]
        joints.append(f'  {{ name = "J{k + 1}", alpha = {text(math.degrees(alpha))}, a = {text(a)}, d = {text(d)}, '
                      f'theta = {text(math.degrees(theta))}, q = [{low}, {high}]'
                      + (", parallel_next = true" if k + 1 in kind.parallel else "") + " },")
    kg, com = kind.payload
    out = ['schema = "cell/1"', "[cell]", f'name = "{name}"', *([f'serial = "{serial}"'] if serial else []), "[robot]",
           f'dh_convention = "{kind.convention}"', 'length_unit = "mm"', 'angle_unit = "deg"',
           "gravity = [0, 0, -9.81]", "joints = [", *joints, "]",
           f"payload = {{ mass_kg = {kg}, com_mm = {list(com)} }}"]
    for joint, mass, centre in kind.links:
        out += ["[[robot.links]]", f'joint = "J{joint}"', f"mass_kg = {mass}", f"com_mm = {list(centre)}",
                'com_frame = "dh"']
    out += ["[measurement]", 'files = ["measurements.csv"]', 'frame = "fit"', 'target = "fit"',
            f"sigma_um = {sigma_um:.3g}", "[effects]", "geometry = true", *effects]
    if fit:
        out += ["[fit]", *fit]
    return "\n".join(out) + "\n"


class BuiltArm:
    """What arms as they were built have in common: kind; behind, a frame for every row that says how its
    link differs from nominal; masses (joint, kg, centre)."""

    def frames(self, q):
        """Axes (point, direction) and the frames behind the rows, in the base frame."""
        frame, axes, behind = HERE, [], []
        for k, (alpha, a, d, theta) in enumerate(self.kind.rows):
            if self.kind.convention == "modified":
                frame = after(frame, about(X, alpha, X, a))
                axes.append((frame[1], column(frame[0], 2)))
                frame = after(frame, about(Z, theta + q[k], Z, d))
            else:
                axes.append((frame[1], column(frame[0], 2)))
                frame = after(frame, about(Z, theta + q[k], Z, d))
                frame = after(frame, about(X, alpha, X, a))
            frame = after(frame, self.behind[k])
            behind.append(frame)
        return axes, behind

    def torques(self, q):
        """Of weight about every axis, N m."""
        axes, behind = self.frames(q)
        weights = [(j, add(behind[j - 1][1], turned(behind[j - 1][0], c)), kg) for j, kg, c in self.masses]
        kg, centre = self.kind.payload
        weights.append((len(axes), add(behind[-1][1], turned(behind[-1][0], centre)), kg))
        return [sum(1e-3 * dot(z, cross(sub(point, o), (0.0, 0.0, -9.81 * m))) for j, point, m in weights if j > k)
                for k, (o, z) in enumerate(axes)]

    def point(self, q, arrived, scatter=None):
        """The reflector in the frame of the tracker, mm."""
        angles = self.angles(q, arrived)
        if scatter:
            angles = [angle + more for angle, more in zip(angles, scatter)]
        _, behind = self.frames(angles)
        tip = add(behind[-1][1], turned(behind[-1][0], self.tool))
        return add(self.base[1], turned(self.base[0], tip))


def visits(kind, rng, n):
    """Random poses in the order of the moves, each with the sides from which its joints arrive."""
    at, out = [math.radians(rng.uniform(*limit)) for limit in kind.limits], []
    for _ in range(n):
        q = [math.radians(rng.uniform(*limit)) for limit in kind.limits]
        out.append((q, [1 if new > old else -1 for new, old in zip(q, at)]))
        at = q
    return out


# ---------------------------------------------------------------------------------- files and programs


class Failed(Exception):
    pass


def told_by(program, *words, limit_s=None):
    """Exit code, the object on stdout (empty if it is none) and the messages. limit_s: a program that has not
    ended by then is killed."""
    command = [program, *map(str, words), "--json"]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=limit_s)
    except subprocess.TimeoutExpired:
        return -1, {}, f"no end after {limit_s} s"
    try:
        told = json.loads(done.stdout)
    except ValueError:
        told = {}
    return done.returncode, told, done.stderr or done.stdout


def plumb(program, cell, *words):
    """The result of one verb."""
    code, told, messages = told_by(program, "-C", cell, *words)
    if code != 0 or not told.get("ok"):
        raise Failed(f"plumb {' '.join(words)}: exit {code}: {messages[-600:]}")
    return told["result"]


def write_readings(path, readings):
    n = len(readings[0][1])
    with open(path, "w", newline="") as out:
        rows = csv.writer(out)
        rows.writerow(["pose"] + [f"q{k + 1}_deg" for k in range(n)] + [f"dir_j{k + 1}" for k in range(n)]
                      + ["x_mm", "y_mm", "z_mm"])
        for name, q, arrived, point in readings:
            rows.writerow([name] + [f"{math.degrees(a):.9f}" for a in q] + arrived + [f"{x:.6f}" for x in point])


def errors_mm(path, truth):
    with open(path, newline="") as file:
        rows = [line for line in csv.DictReader(line for line in file if not line.startswith("#"))]
    if len(rows) != len(truth):
        raise Failed(f"{path}: {len(rows)} rows, not {len(truth)}")
    return [norm(sub(tuple(float(row[f"p{axis}_mm"]) for axis in "xyz"), point)) for row, point in zip(rows, truth)]


# ------------------------------------------------------------------------------------ marks and tables


def share_mark(name, values, limit_pct, at_least):
    """A row of the table: a share and its limit, loosened by two standard errors of so many cases."""
    n = len(values)
    if n == 0:
        return None
    share = sum(values) / n
    limit = limit_pct / 100.0
    allowance = 2.0 * math.sqrt(limit * (1.0 - limit) / n)
    kept = share >= limit if at_least else share <= limit
    within = share >= limit - allowance if at_least else share <= limit + allowance
    return (name, f"{100 * share:.1f} % of {n}", f"{'>=' if at_least else '<='} {limit_pct:g} %",
            "passed" if kept else "missed, within the allowance" if within else "missed", within)


def print_table(head, rows, markdown):
    if markdown:
        print("| " + " | ".join(head) + " |\n|" + "---|" * len(head))
        for row in rows:
            print("| " + " | ".join(row) + " |")
    else:
        widths = [max(len(row[k]) for row in [head, *rows]) for k in range(len(head))]
        for row in [head, *rows]:
            print("  " + "  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip())
    print()
