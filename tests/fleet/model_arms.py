# SPDX-License-Identifier: Apache-2.0
"""Arms of three models that differ from nominal and from each other, for the blind studies of sisters."""
import math

from blind_arms import (BuiltArm, Kind, add, column, cross, dot, rotation, sub, times, turned, visits)

# ----------------------------------------------------------------------------------- three models

KINDS = [
    Kind("light", "standard",
         [(90, 0, 127.3, 0), (0, -612, 0, 0), (0, -572.3, 0, 0), (90, 0, 163.9, 0), (-90, 0, 115.7, 0),
          (0, 0, 92.2, 0)],
         [(-170, 170), (-150, -20), (-130, 130), (-170, 170), (-170, 170), (-170, 170)],
         [(2, 12.4, (232, 0, 158)), (3, 8.7, (240, 0, 49)), (4, 2.0, (0, 7, 26)), (5, 2.0, (0, 7, 26)),
          (6, 0.4, (0, 0, -28))],
         {2: 2.5e-6, 3: 4e-6}, (), (35, 20, 140), (3.0, (0, 10, 50)), (2, 3)),
    Kind("elbow", "modified",
         [(0, 0, 675, 0), (-90, 260, 0, -90), (0, 680, 0, 0), (-90, 35, 670, 0), (90, 0, 0, 0),
          (-90, 0, 158, 0)],
         [(-160, 160), (-70, 60), (-80, 100), (-180, 180), (-120, 120), (-200, 200)],
         [(2, 60.0, (310, 0, 40)), (3, 40.0, (60, 90, -10)), (4, 22.0, (0, 10, -230)), (5, 9.0, (0, -30, 10)),
          (6, 3.0, (0, 0, -30))],
         {2: 3e-7, 3: 6e-7}, (), (60, -35, 180), (16.0, (10, 20, 80)), (2,)),
    Kind("small", "standard",
         [(90, 0, 660.4, 0), (0, 431.8, 0, 0), (-90, 20.3, 150.05, 0), (90, 0, 431.8, 0), (-90, 0, 0, 0),
          (0, 0, 56.25, 0)],
         [(-150, 150), (-40, 160), (-200, 20), (-160, 160), (-100, 100), (-180, 180)],
         [(2, 17.4, (-360, 6, 220)), (3, 4.8, (-14, 0, 70)), (4, 0.8, (0, 190, 0)), (5, 0.34, (0, 0, 0)),
          (6, 0.1, (0, 0, 30))],
         {}, (), (40, 30, 110), (1.0, (0, 0, 40)), (2,)),
]
AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
ERRORS_OF_A_JOINT = 7      # its encoder [rad], then turns [rad] and shifts [mm] of the frame behind it
SIZES = (1e-3,) * 4 + (1.0,) * 3    # 1 stands for 1 mm or 1 mrad
ORIGINS = [(rotation(axis), (0.0, 0.0, 0.0)) for axis in AXES]


class Model:
    """What the arms of one model have in common, and how far they differ."""

    def __init__(self, kind, rng, spread):
        self.kind = kind
        many = range(kind.joints() * ERRORS_OF_A_JOINT)
        self.mean = [rng.choice((-1, 1)) * rng.uniform(0.1, 0.4) for _ in many]
        self.spread = [math.exp(rng.uniform(*map(math.log, spread))) for _ in many]
        self.springs = {j: c * rng.uniform(0.8, 1.25) for j, c in kind.springs.items()}
        self.masses = [(j, kg * rng.uniform(0.95, 1.05), add(c, tuple(rng.gauss(0, 5.0) for _ in "xyz")))
                       for j, kg, c in kind.links]
        self.wave_joint = rng.randint(1, 3)     # whose gear has waves in some of the arms
        self.scatter = [rng.uniform(10e-6, 60e-6) for _ in range(kind.joints())]    # from visit to visit
        plain = Arm(self, [0.0] * len(self.mean), {}, (0.0,) * 4)
        loads = [plain.torques(q) for q, _ in visits(kind, rng, 60)]
        self.largest = [max(abs(load[k]) for load in loads) or 1.0 for k in range(kind.joints())]


class Arm(BuiltArm):
    """One arm as it was built. values: of Model.mean's kind, in units of SIZES; waves: sine and cosine of one
    and two cycles a turn [rad]."""
    hardening = 0.0

    def __init__(self, model, values, springs, waves):
        self.model, self.kind, self.masses = model, model.kind, model.masses
        self.values, self.springs, self.waves = values, springs, waves
        self.tool, self.base = self.kind.tool, ORIGINS[0]
        self.offset, self.behind = [], []
        for k in range(0, len(values), ERRORS_OF_A_JOINT):
            one = [v * size for v, size in zip(values[k:k + ERRORS_OF_A_JOINT], SIZES)]
            self.offset.append(one[0])
            self.behind.append((rotation(tuple(one[1:4])), tuple(one[4:])))

    def angles(self, q, _arrived):
        out = [value + more for value, more in zip(q, self.offset)]
        if self.springs:
            load = self.torques(out)
            for j, c in self.springs.items():
                share = min(1.0, abs(load[j - 1]) / self.model.largest[j - 1])
                out[j - 1] += c * load[j - 1] * (1.0 - self.hardening * share * share)
        out[self.model.wave_joint - 1] += dot4(self.waves, waves_of(q[self.model.wave_joint - 1]))
        return out


def waves_of(angle):
    return (math.sin(angle), math.cos(angle), math.sin(2 * angle), math.cos(2 * angle))


def dot4(a, b):
    return sum(x * y for x, y in zip(a, b))


def built(model, rng, number):
    """An arm of the model, with its tracker. Every third one has waves in a gear."""
    values = [mean + rng.gauss(0, spread) for mean, spread in zip(model.mean, model.spread)]
    springs = {j: c * rng.uniform(0.85, 1.15) for j, c in model.springs.items()}
    size, turn, turn2 = rng.uniform(100e-6, 400e-6), rng.uniform(0, 2 * math.pi), rng.uniform(0, 2 * math.pi)
    waves = (size * math.cos(turn), size * math.sin(turn), 0.3 * size * math.cos(turn2), 0.3 * size * math.sin(turn2))
    out = Arm(model, values, springs, waves if number // len(KINDS) % 3 == 1 else (0.0,) * 4)
    out.hardening = 0.15
    out.tool = add(model.kind.tool, tuple(rng.gauss(0, 2.0) for _ in "xyz"))
    out.base = (rotation((rng.gauss(0, 0.02), rng.gauss(0, 0.02), rng.uniform(-3, 3))),
                (rng.uniform(-3000, 3000), rng.uniform(-3000, 3000), rng.uniform(-500, 500)))
    out.sigma_mm = round(rng.uniform(0.020, 0.040), 4)
    return out


def measured(arm, rng, n):
    out = []
    for row, (q, sides) in enumerate(visits(arm.kind, rng, n)):
        true = arm.point(q, sides, [rng.gauss(0, one) for one in arm.model.scatter])
        out.append((f"P{row + 1:02d}", q, sides, tuple(x + rng.gauss(0, arm.sigma_mm) for x in true)))
    return out


# --------------------------------------------------------------------------- what could be reached


def solved(matrix, right):
    """Of a symmetric positive definite matrix, by Cholesky."""
    n, low = len(right), []
    for i in range(n):
        row = []
        for j in range(i + 1):
            rest = matrix[i][j] - sum(a * b for a, b in zip(row, low[j] if j < i else row))
            row.append(math.sqrt(rest) if i == j else rest / low[j][j])
        low.append(row)
    forth = []
    for i in range(n):
        forth.append((right[i] - dot4(low[i], forth)) / low[i][i])
    back = [0.0] * n
    for i in reversed(range(n)):
        back[i] = (forth[i] - sum(low[k][i] * back[k] for k in range(i + 1, n))) / low[i][i]
    return back


def columns_of(arm, q, sides, waved):
    """Derivatives of the measured point, in the order of estimated()."""
    axes, behind = arm.frames(arm.angles(q, sides))
    load = arm.torques(arm.angles(q, sides))
    tip = add(behind[-1][1], turned(behind[-1][0], arm.tool))
    of_joint = [cross(z, sub(tip, o)) for o, z in axes]
    out = []
    for k, (rows, origin) in enumerate(behind):
        ways = [column(rows, axis) for axis in range(3)]
        out.append(times(1e-3, of_joint[k]))
        out += [times(1e-3, cross(way, sub(tip, origin))) for way in ways]
        out += ways
    out += [times(1e-6 * load[j - 1], of_joint[j - 1]) for j in sorted(arm.springs)]
    if waved:
        j = arm.model.wave_joint - 1
        out += [times(1e-3 * wave, of_joint[j]) for wave in waves_of(q[j])]
    out += [column(behind[-1][0], axis) for axis in range(3)]
    out = [turned(arm.base[0], one) for one in out]
    lever = turned(arm.base[0], tip)
    return out + list(AXES) + [times(1e-3, cross(axis, lever)) for axis in AXES]


def weights_of(arm, columns):
    """The inverse covariance of a reading: noise of the tracker and scatter of the joints."""
    rows = [[arm.sigma_mm ** 2 if a == b else 0.0 for b in range(3)] for a in range(3)]
    for k, size in enumerate(arm.model.scatter):
        lever = times(1e3 * size, columns[k * ERRORS_OF_A_JOINT])
        for a in range(3):
            for b in range(3):
                rows[a][b] += lever[a] * lever[b]
    return [solved(rows, axis) for axis in AXES]


def estimated(arm, readings, known, near=None, waved=None):
    """What linear least squares with a normal prior makes of the readings. known: of the arm's true model, the
    mean and spread; else nominal, give or take 0.5 mm and 0.5 mrad, as an arm alone is calibrated. near: another
    arm of the model and how far its single errors, relatively its springs, and its waves are from those of this
    one, the last None if they have nothing in common. waved: whether waves are estimated, else if there are any."""
    model, n = arm.model, len(arm.values)
    other, spread, soft, wave = near or (None, None, 0.09 if known else 1.0, None)
    at = Arm(model, list(other.values if other else model.mean if known else [0.0] * n),
             dict((other or model).springs), (0.0,) * 4 if wave is None else other.waves)
    at.tool, at.base = arm.tool, arm.base
    waved = any(arm.waves) if waved is None else waved
    sds = [spread] * n if other else list(model.spread) if known else [0.5] * n
    sds += [1e6 * model.springs[j] * soft for j in sorted(model.springs)]
    sds += [0.15 if wave is None else wave] * 4 if waved else []
    sds += [100.0] * 9
    size = len(sds)
    matrix = [[0.0] * size for _ in range(size)]
    right = [0.0] * size
    for _, q, sides, point in readings:
        columns = columns_of(at, q, sides, waved)
        off = sub(point, at.point(q, sides))
        weights = weights_of(arm, columns)
        weighted = turned(weights, off)
        for i, one in enumerate(columns):
            right[i] += dot(one, weighted)
            heavy, row = turned(weights, one), matrix[i]
            for j in range(i + 1):
                row[j] += dot(heavy, columns[j])
    for i, sd in enumerate(sds):
        matrix[i][i] += 1.0 / sd ** 2
    found = solved(matrix, right)
    springs = {j: c + 1e-6 * more for (j, c), more in zip(sorted(at.springs.items()), found[n:])}
    rest = found[n + len(springs):]
    out = Arm(model, [a + b for a, b in zip(at.values, found)], springs,
              tuple(a + 1e-3 * b for a, b in zip(at.waves, rest)) if waved else (0.0,) * 4)
    out.tool = add(arm.tool, tuple(rest[-9:-6]))
    turn = rotation(times(1e-3, tuple(rest[-3:])))
    out.base = (tuple(tuple(dot(row, column(arm.base[0], k)) for k in range(3)) for row in turn),
                add(arm.base[1], tuple(rest[-6:-3])))
    return out
