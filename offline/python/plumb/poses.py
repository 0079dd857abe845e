# SPDX-License-Identifier: Apache-2.0
"""Poses from what files hold."""
from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

QUATERNION_SLACK = 1e-3  # as plumb allows in a file: lengths differ from 1 by rounded decimals


def poses(xyz_m: ArrayLike, quat_wxyz: ArrayLike) -> NDArray[np.float64]:
    """Poses (N, 4, 4) of positions (N, 3) in [m] and unit quaternions (N, 4), as plumb reads x_mm ... and qw ..."""
    p, q = np.asarray(xyz_m, np.float64), np.asarray(quat_wxyz, np.float64)
    if p.ndim != 2 or q.ndim != 2 or p.shape[1] != 3 or q.shape != (len(p), 4):
        raise ValueError(f"positions {p.shape} and quaternions {q.shape} must have the shapes (N, 3) and (N, 4)")
    w, x, y, z = q.T
    norm = np.sqrt(w * w + x * x + y * y + z * z)
    bad = np.flatnonzero(~(np.abs(norm - 1.0) <= QUATERNION_SLACK))
    if bad.size:
        raise ValueError(f"the quaternion of row {bad[0]} has length {norm[bad[0]]:.6g}, not 1: check the order w, x, y, z")
    w, x, y, z = w / norm, x / norm, y / norm, z / norm
    T = np.zeros((len(p), 4, 4))
    T[:, :3, 3] = p
    T[:, 3, 3] = 1.0
    T[:, 0, 0], T[:, 0, 1], T[:, 0, 2] = 1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)
    T[:, 1, 0], T[:, 1, 1], T[:, 1, 2] = 2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)
    T[:, 2, 0], T[:, 2, 1], T[:, 2, 2] = 2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)
    return T
