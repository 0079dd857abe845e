# SPDX-License-Identifier: Apache-2.0
"""The C interface of Plumb, runtime/include/plumb.h, as far as arrays need it."""
from __future__ import annotations

import ctypes
import functools
import os
from ctypes import POINTER, c_char_p, c_double, c_int, c_int32, c_size_t, c_uint32, c_uint64, c_void_p

Doubles = POINTER(c_double)
MESSAGE = 500  # bytes: room for one sentence

MAX_TEMPERATURES = 8  # PLUMB_MAX_TEMPERATURES
MEASURED, COMMANDED = 2, 4  # PLUMB_MEASURED, PLUMB_COMMANDED
RESULTS = ("OK", "NULL", "MISALIGNED", "BAD_SIZE", "NOT_A_ROBOT", "UNREADABLE", "UNKNOWN_EFFECT", "OTHER_ROBOT", "BUSY",
           "NO_MEMORY", "BAD_NUMBER", "RUNNING")  # of plumb_result


class Rows(ctypes.Structure):
    """plumb_rows"""

    _fields_ = [("size", c_uint32), ("seed", c_uint32), ("count", c_uint64), ("q", Doubles), ("payload_kg", Doubles),
                ("payload_com_m", Doubles), ("temperature_degC", Doubles), ("time_s", Doubles), ("direction", Doubles),
                ("travel", Doubles)]


@functools.lru_cache(maxsize=None)
def library() -> ctypes.CDLL:
    """The library that PLUMB_LIBRARY names, or the one that the system's loader finds."""
    name = os.environ.get("PLUMB_LIBRARY") or ("plumb.dll" if os.name == "nt" else "libplumb.so.0")
    try:
        c = ctypes.CDLL(name)
    except OSError as error:
        raise FileNotFoundError(f"the library '{name}' cannot be loaded ({error}): install the package libplumb0, or set the "
                                "environment variable PLUMB_LIBRARY to the library") from None
    c.plumb_load_file.argtypes = [c_char_p, c_char_p, POINTER(c_void_p), c_char_p, c_size_t]
    c.plumb_unload.argtypes = c.plumb_joint_count.argtypes = c.plumb_serial.argtypes = [c_void_p]
    c.plumb_temperature_name.argtypes = [c_void_p, c_int]
    c.plumb_predict_rows.argtypes = [c_void_p, POINTER(Rows), c_void_p, c_void_p]
    c.plumb_correct_rows.argtypes = [c_void_p, POINTER(Rows), c_void_p, c_void_p, c_void_p, c_void_p]
    c.plumb_status_text.argtypes = [c_int32]
    for text in (c.plumb_serial, c.plumb_temperature_name, c.plumb_status_text):
        text.restype = c_char_p
    return c


def status_text(status: int) -> str:
    """ "ok", "outside-domain", ...: the words of plumb predict and plumb correct"""
    text: bytes = library().plumb_status_text(status)
    return text.decode()
