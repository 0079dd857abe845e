# SPDX-License-Identifier: Apache-2.0
"""What is raised, and what is warned of."""
from __future__ import annotations

from typing import Any, Optional


class PlumbError(Exception):
    """An error of the program plumb, or of a model file. Wrong calls from Python raise ValueError instead."""

    def __init__(self, message: str, code: str = "", help: str = "", exit_code: int = 3, place: str = "",
                 json: Optional[dict[str, Any]] = None) -> None:
        super().__init__(message, code, help, exit_code, place, json)
        self.message = message
        self.code = code
        """Stable name, such as E-CSV-UNIT; plumb explain CODE describes it. Of a model file that name of plumb.h."""
        self.help = help
        """One line that says what to do; may be empty."""
        self.exit_code = exit_code
        """As in docs/exit-codes.md."""
        self.place = place
        """FILE:LINE:COLUMN, as far as it is known."""
        self.json = json
        """All that plumb printed with --json; after a failed gate its result is complete."""

    def __str__(self) -> str:
        lines = [f"{self.code}: {self.message}" if self.code else self.message]
        lines += [f"  --> {self.place}"] if self.place else []
        lines += [f"  = help: {self.help}"] if self.help else []
        return "\n".join(lines)


class PlumbWarning(UserWarning):
    """A warning of plumb: it was done, but read this."""
