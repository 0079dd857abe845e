# SPDX-License-Identifier: Apache-2.0
"""The program plumb, run with --json."""
from __future__ import annotations

import json
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import threading
import warnings
from typing import Any, Optional, TypeVar, Union

from .answer import Answer, Option, Progress, Word, answer_of
from .errors import PlumbError, PlumbWarning
from .verbs import Verbs

Result = TypeVar("Result")
INTERRUPTED_S = 10  # so long a verb may take to end when it is interrupted
STILL_AT_WORK = " ..."  # the end of a line of progress


def found_program() -> str:
    """The program that PLUMB names, or the one on PATH."""
    named = os.environ.get("PLUMB")
    found = shutil.which(named or "plumb")
    if found is None:
        raise FileNotFoundError(f"the program '{named or 'plumb'}' is not installed: install the package plumb, put plumb "
                                "on PATH, or set the environment variable PLUMB to the program")
    return found


def words_of(options: dict[str, Option]) -> list[str]:
    """max_rms=0.1 -> --max-rms=0.1; True -> the option alone; a list with commas; a dict as NAME=VALUE, again for each."""
    out = []
    for name, value in options.items():
        option = "--" + name.strip("_").replace("_", "-")
        if value is None or value is False:
            continue
        if value is True:
            out.append(option)
        elif isinstance(value, dict):
            out += [f"{option}={key}={one}" for key, one in value.items()]
        elif isinstance(value, (list, tuple)):
            out.append(f"{option}={','.join(os.fspath(one) if isinstance(one, os.PathLike) else str(one) for one in value)}")
        else:
            out.append(f"{option}={os.fspath(value) if isinstance(value, os.PathLike) else value}")
    return out


class Program(Verbs):
    """Every verb of plumb, without a cell: plumb.Program().demo("mixed", "mycell")"""

    _at: tuple[str, ...] = ()

    def _run(self, verb: str, words: tuple[Word, ...], options: dict[str, Option], kind: type[Result],
             progress: Optional[Progress]) -> Answer[Result]:
        command = [found_program(), *self._at, verb, *map(str, words), *words_of(options), "--json"]
        code, text, said = _ran(command, progress)
        try:
            printed = json.loads(text)
        except json.JSONDecodeError:
            raise RuntimeError(f"'{' '.join(command)}' ended with {code} and without an answer: {said.strip()}") from None
        if printed["error"] is not None:
            raise _error_of(printed)
        answer = answer_of(printed, kind, self._figure if self._at else None)
        for one in answer.warnings:
            if one.severity == "warning":
                warnings.warn(f"{one.code}: {one.message}", PlumbWarning, stacklevel=3)
        return answer

    def _figure(self, name: str) -> str:
        with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
            warnings.simplefilter("ignore", PlumbWarning)  # said by the verb that is shown
            file = pathlib.Path(folder, "figure.svg")
            self.plot(name, output=file)
            return file.read_text(encoding="utf-8")


class Cell(Program):
    """A cell, the folder of a cell.toml: plumb.Cell("mycell").fit()"""

    def __init__(self, folder: Union[str, os.PathLike[str]] = ".") -> None:
        self.folder = pathlib.Path(folder)
        self._at = ("-C", os.fspath(folder))

    def __repr__(self) -> str:
        return f"plumb.Cell({os.fspath(self.folder)!r})"


def _ran(command: list[str], progress: Optional[Progress]) -> tuple[int, str, str]:
    """Exit code, standard output and standard error. An interruption of Python is passed on before it goes on here."""
    said: list[str] = []
    with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          encoding="utf-8", errors="replace") as child:
        assert child.stdout is not None and child.stderr is not None
        text: list[str] = []
        reader = threading.Thread(target=lambda out: text.append(out.read()), args=(child.stdout,), daemon=True)
        reader.start()
        try:
            for line in child.stderr:
                said.append(line)
                step = line.rstrip()
                if progress is not None and step.endswith(STILL_AT_WORK):
                    progress(step[:-len(STILL_AT_WORK)])
            code = child.wait()
        except BaseException:
            _interrupt(child)
            raise
        reader.join()
    return code, "".join(text), "".join(said)


def _interrupt(child: subprocess.Popen[str]) -> None:
    child.send_signal(signal.SIGINT) if os.name == "posix" else child.terminate()
    try:
        child.wait(INTERRUPTED_S)
    except subprocess.TimeoutExpired:
        child.kill()


def _error_of(printed: dict[str, Any]) -> PlumbError:
    error = printed["error"]
    place = error["place"] or {}
    at = ":".join(str(place[part]) for part in ("file", "line", "column") if place.get(part))
    return PlumbError(error["message"], error["code"], error["help"], error["exit"], at, printed)
