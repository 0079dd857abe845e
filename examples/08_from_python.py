# SPDX-License-Identifier: Apache-2.0
# From measurements to corrected targets in Python: 08_from_python.py CELL, the folder of a cell.toml.
import sys

import numpy as np
import plumb

cell = plumb.Cell(sys.argv[1])  # reads the measurements.csv that its cell.toml names
cell.fit(progress=print)
found = cell.diagnose(apply=True).result
print(found.verdict_text, [effect.effect for effect in found.added])
cell.compile(force=True)

robot = plumb.Robot.load(cell.folder / "robot.plumb")
table = np.genfromtxt(cell.folder / "targets.csv", delimiter=",", names=True)
take = lambda *names: np.array([table[name] for name in names]).T
targets = plumb.poses(take("x_mm", "y_mm", "z_mm") / 1000, take("qw", "qx", "qy", "qz"))
corrected = robot.correct(targets, np.radians(take(*(f"q{j + 1}_deg" for j in range(robot.joints)))))
moved_mm = 1000 * np.linalg.norm(corrected.T[:, :3, 3] - targets[:, :3, 3], axis=1)
print(f"{len(targets)} targets, {corrected.refused.sum()} refused, the largest correction is {moved_mm.max():.3f} mm")
