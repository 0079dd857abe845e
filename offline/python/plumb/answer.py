# SPDX-License-Identifier: Apache-2.0
"""What a verb answers, and how it is made from the JSON object that plumb prints."""
from __future__ import annotations

import dataclasses
import functools
import keyword
import os
import typing
from typing import Any, Callable, Generic, Optional, TypeVar, Union

from . import results

Word = Union[str, int, float, "os.PathLike[str]"]
Option = Union[None, bool, Word, "list[Word]", "tuple[Word, ...]", "dict[str, str]"]
Progress = Callable[[str], object]
Result = TypeVar("Result")


@dataclasses.dataclass(frozen=True)
class Answer(Generic[Result]):
    """The answer to one verb; a notebook shows it as plumb does, with its figures."""

    command: str
    version: str
    inputs: list[results.InputFile]
    warnings: list[results.Problem]
    """Warnings and notes."""
    result: Result
    json: dict[str, Any] = dataclasses.field(repr=False)
    """All that plumb printed, as it is."""
    figure: Optional[Callable[[str], str]] = dataclasses.field(default=None, repr=False, compare=False)
    """A figure of plumb plot as SVG text, by its name."""

    def _repr_html_(self) -> str:
        from .notebook import page
        return page(self.json, self.figure)


def answer_of(json: dict[str, Any], kind: type[Result], figure: Optional[Callable[[str], str]]) -> Answer[Result]:
    return Answer(json["command"], json["version"], made(list[results.InputFile], json["inputs"]),
                  made(list[results.Problem], json["warnings"]), made(kind, json["result"]), json, figure)


@functools.lru_cache(maxsize=None)
def _members(kind: Any) -> dict[str, tuple[str, Any]]:
    """Of a dataclass, for each name in JSON that of the member and its type."""
    types = typing.get_type_hints(kind, vars(results))
    plain = {name: name[:-1] if keyword.iskeyword(name.rstrip("_")) else name for name in types}
    return {plain[name]: (name, types[name]) for name in types}


def made(kind: Any, value: Any) -> Any:
    """The JSON value as this type. Members that the type does not know are of a newer plumb: they are passed over."""
    origin, inner = typing.get_origin(kind), typing.get_args(kind)
    if origin is Union:
        return None if value is None else made(_chosen(inner, value), value)
    if origin is list:
        return [made(inner[0], one) for one in value]
    if origin is dict:
        return {name: made(inner[1], one) for name, one in value.items()}
    if kind is float and isinstance(value, int):
        return float(value)
    if not dataclasses.is_dataclass(kind):
        return value
    members = _members(kind)
    out = {members[name][0]: made(members[name][1], one) for name, one in value.items() if name in members}
    if "more" in members:
        out["more"] = {name: one for name, one in value.items() if name not in members}
    return kind(**out)


def _chosen(kinds: tuple[Any, ...], value: Any) -> Any:
    """Which of a union's types a value is of: the first that it fits."""
    return next((kind for kind in kinds if _fits(kind, value)), Any)


def _fits(kind: Any, value: Any) -> bool:
    if dataclasses.is_dataclass(kind):
        found = {member for name, (member, _) in _members(kind).items() if isinstance(value, dict) and name in value}
        return isinstance(value, dict) and found >= {field.name for field in dataclasses.fields(kind) if _always(field)}
    if typing.get_origin(kind) is Union:
        return any(_fits(one, value) for one in typing.get_args(kind))
    if typing.get_origin(kind) is list:
        return isinstance(value, list) and (not value or _fits(typing.get_args(kind)[0], value[0]))
    if typing.get_origin(kind) is dict:
        return isinstance(value, dict)
    return kind is type(value) or (kind is float and type(value) is int)


def _always(field: dataclasses.Field[Any]) -> bool:
    return field.default is dataclasses.MISSING and field.default_factory is dataclasses.MISSING
