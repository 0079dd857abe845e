# SPDX-License-Identifier: Apache-2.0
"""A compiled model on arrays."""
from __future__ import annotations

import ctypes
import os
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any, Callable, Mapping, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import PlumbError
from .library import COMMANDED, MAX_TEMPERATURES, MEASURED, MESSAGE, RESULTS, Doubles, Rows, library, status_text

Numbers = NDArray[np.float64]
ROWS_OF_A_THREAD = 10_000  # fewer are not worth one


@dataclass(frozen=True)
class Prediction:
    """Where the tool truly is: T (N, 4, 4) in the base frame [m], and status (N,), a number of plumb_status each."""

    T: Numbers
    status: NDArray[np.int32]

    @property
    def status_text(self) -> list[str]:
        return [status_text(one) for one in self.status.tolist()]

    @property
    def refused(self) -> NDArray[np.bool_]:
        return self.status < 0


@dataclass(frozen=True)
class Correction(Prediction):
    """What to command: T (N, 4, 4), the target itself where refused; q (N, dof) brings the true arm to the target."""

    q: Numbers


class Robot:
    """The arm of a model file. SI units: [rad] or [m] for joints, [m] in poses. Any threads may use it at once.

    What is known of a pose beside its joints is given by name, for all rows or row by row, NaN where unknown: payload_kg,
    payload_com_m (three, flange frame), temperature_degC ({sensor: values}), time_s, direction and travel of each joint's
    last move. What is not given is unknown, as a missing column is to plumb predict and plumb correct.
    """

    def __init__(self, handle: ctypes.c_void_p, name: str) -> None:
        c = library()
        self._handle, self._name = handle, name
        self.joints: int = c.plumb_joint_count(handle)
        self.serial: str = c.plumb_serial(handle).decode()
        names = (c.plumb_temperature_name(handle, k) for k in range(MAX_TEMPERATURES))
        self.temperatures: list[str] = [one.decode() for one in names if one is not None]

    @classmethod
    def load(cls, file: Union[str, os.PathLike[str]], serial: Optional[str] = None) -> Robot:
        """The model of plumb compile; with a serial number only if it was made for that robot. Raises PlumbError."""
        handle, message = ctypes.c_void_p(), ctypes.create_string_buffer(MESSAGE)
        result = library().plumb_load_file(os.fsencode(file), None if serial is None else serial.encode(),
                                           ctypes.byref(handle), message, MESSAGE)
        if result != 0:
            raise PlumbError(message.value.decode(errors="replace"), "PLUMB_" + RESULTS[result], place=os.fspath(file),
                             help="plumb compile makes a model file; plumb inspect says what is in it")
        return cls(handle, os.fspath(file))

    def unload(self) -> None:
        """Frees the model now; else that is done with the object."""
        if self._handle:
            library().plumb_unload(self._handle)
            self._handle = ctypes.c_void_p()

    def __enter__(self) -> Robot:
        return self

    def __exit__(self, *_: object) -> None:
        self.unload()

    def __del__(self) -> None:
        if getattr(self, "_handle", None):
            self.unload()

    def __repr__(self) -> str:
        return f"plumb.Robot.load({self._name!r})"

    def predict(self, q: ArrayLike, **known: Union[ArrayLike, Mapping[str, ArrayLike]]) -> Prediction:
        """Where the tool truly is at joints q (N, dof), as plumb predict says it."""
        c, rows = library(), _RowsOf(self, "q", q, known)
        poses, status = np.empty((rows.count, 12)), np.empty(rows.count, np.int32)
        rows.run(lambda part, first: c.plumb_predict_rows(
            self._handle, ctypes.byref(part), poses[first:].ctypes.data, status[first:].ctypes.data))
        return Prediction(_matrices(poses), status)

    def correct(self, T: ArrayLike, seed: ArrayLike, commanded: bool = False,
                **known: Union[ArrayLike, Mapping[str, ArrayLike]]) -> Correction:
        """What to command so that the tool truly reaches T (N, 4, 4), from joints seed (N, dof), as plumb correct says it.
        commanded: the seed is what the controller commands for T, which arms of seven joints or more need."""
        c, rows = library(), _RowsOf(self, "seed", seed, known, COMMANDED if commanded else MEASURED)
        targets = _targets(T, rows.count)
        poses, status, q = np.empty_like(targets), np.empty(rows.count, np.int32), np.empty((rows.count, self.joints))
        rows.run(lambda part, first: c.plumb_correct_rows(
            self._handle, ctypes.byref(part), targets[first:].ctypes.data, poses[first:].ctypes.data,
            q[first:].ctypes.data, status[first:].ctypes.data))
        return Correction(_matrices(poses), status, q)


class _RowsOf:
    """The rows of one call: arrays that the library reads, kept as long as it does."""

    def __init__(self, robot: Robot, name: str, q: ArrayLike, known: Mapping[str, Union[ArrayLike, Mapping[str, ArrayLike]]],
                 seed: int = MEASURED) -> None:
        if not robot._handle:
            raise ValueError(f"this robot is unloaded: load it again with {robot!r}")
        joints = _finite(name, q)
        if joints.ndim != 2 or joints.shape[1] != robot.joints:
            raise ValueError(f"{name} has the shape {joints.shape}: the arm has {robot.joints} joints, so give (N, {robot.joints})")
        self.count, self._seed = len(joints), seed
        self._arrays: dict[str, Numbers] = {"q": joints}
        widths = {"payload_kg": 1, "payload_com_m": 3, "time_s": 1, "direction": robot.joints, "travel": robot.joints}
        for what, values in known.items():
            if what == "temperature_degC":
                self._arrays[what] = self._temperatures(robot, values)
            elif what in widths and not isinstance(values, Mapping):
                self._arrays[what] = self._spread(what, values, widths[what])
            else:
                raise TypeError(f"'{what}' is not known: give {', '.join(widths)} or temperature_degC as a dict")
        if "payload_com_m" in self._arrays and "payload_kg" not in self._arrays:
            raise ValueError("payload_com_m belongs to a payload: give payload_kg as well")

    def _spread(self, what: str, values: ArrayLike, width: int) -> Numbers:
        """One value, one a row, or of several numbers one row or all of them."""
        given = np.asarray(values, np.float64)
        shape = (self.count,) if width == 1 else (self.count, width)
        try:
            return np.ascontiguousarray(np.broadcast_to(given, shape))
        except ValueError:
            raise ValueError(f"{what} has the shape {given.shape}: give {shape} or what spreads to it") from None

    def _temperatures(self, robot: Robot, values: Union[ArrayLike, Mapping[str, ArrayLike]]) -> Numbers:
        sensors = ", ".join(robot.temperatures) or "none"
        if not isinstance(values, Mapping):
            raise TypeError(f"temperature_degC is a dict of sensor and values; the sensors of this model: {sensors}")
        out = np.full((self.count, len(robot.temperatures)), np.nan)
        for name, one in values.items():
            if name not in robot.temperatures:
                raise ValueError(f"this model has no sensor '{name}', but: {sensors}")
            out[:, robot.temperatures.index(name)] = self._spread(name, one, 1)
        return out

    def _part(self, first: int, end: int) -> Rows:
        pointers = {name: array[first:].ctypes.data_as(Doubles) for name, array in self._arrays.items()}
        return Rows(size=ctypes.sizeof(Rows), seed=self._seed, count=end - first, **pointers)

    def run(self, call: Callable[[Rows, int], Any]) -> None:
        """Calls the library for parts of the rows, which it works on side by side."""
        threads = max(1, min(os.cpu_count() or 1, self.count // ROWS_OF_A_THREAD))
        ends = [self.count * k // threads for k in range(threads + 1)]
        parts = list(zip(ends, ends[1:]))
        with ThreadPoolExecutor(threads) as pool:
            for result in pool.map(lambda part: int(call(self._part(*part), part[0])), parts):
                if result != 0:
                    raise RuntimeError(f"the library answered PLUMB_{RESULTS[result]}")


def _finite(name: str, values: ArrayLike) -> Numbers:
    out = np.ascontiguousarray(values, np.float64)
    if not np.isfinite(out).all():
        raise ValueError(f"row {np.argwhere(~np.isfinite(out))[0][0]} of {name} holds NaN or an infinite number")
    return out


def _targets(T: ArrayLike, count: int) -> Numbers:
    """Positions and rotations as plumb_pose, shape (N, 12)."""
    given = _finite("T", T)
    if given.shape != (count, 4, 4):
        raise ValueError(f"T has the shape {given.shape}: with {count} rows of seed give ({count}, 4, 4)")
    if not (given[:, 3] == (0.0, 0.0, 0.0, 1.0)).all():
        raise ValueError("the last row of each matrix of T must be 0, 0, 0, 1")
    out = np.empty((count, 12))
    out[:, :3] = given[:, :3, 3]
    out[:, 3:] = given[:, :3, :3].reshape(count, 9)
    return out


def _matrices(poses: Numbers) -> Numbers:
    out = np.zeros((len(poses), 4, 4))
    out[:, :3, 3] = poses[:, :3]
    out[:, :3, :3] = poses[:, 3:].reshape(-1, 3, 3)
    out[:, 3, 3] = 1.0
    return out
