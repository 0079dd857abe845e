# SPDX-License-Identifier: Apache-2.0
"""Plumb in Python: the verbs of the program plumb, and a compiled model on arrays. See docs/python.md."""
from .answer import Answer
from .errors import PlumbError, PlumbWarning
from .poses import poses
from .program import Cell, Program
from .results import VERSION as __version__
from .robot import Correction, Prediction, Robot

__all__ = ["Answer", "Cell", "Correction", "PlumbError", "PlumbWarning", "Prediction", "Program", "Robot", "__version__", "poses"]
