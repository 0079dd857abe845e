#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the results and the verbs of the Python package from docs/schemas and the version: tests/pages/python_types.py"""
import json
import keyword
import pathlib
import re

import json_page

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PACKAGE = SOURCE / "offline/python/plumb"
NOT_OF_PLUMB = ("rt-", "twin-")
FOR_EVER = ("serve",)  # a verb that ends with a signal gives no answer
KINDS = {"integer": "int", "number": "float", "string": "str", "boolean": "bool", "null": "None"}
HEAD = ["# SPDX-License-Identifier: Apache-2.0", "# Made from docs/schemas by tests/pages/python_types.py; do not edit."]


def class_name(words):
    """held_out, modbus-map -> HeldOut, ModbusMap"""
    return "".join(word[:1].upper() + word[1:] for word in re.split("[_-]", words))


def python_name(word):
    """A name that Python allows: class -> class_, modbus-map -> modbus_map"""
    name = word.replace("-", "_")
    return name + "_" if keyword.iskeyword(name) else name


def sentence(words):
    return " ".join(words.split()).replace("\\", "\\\\").replace('"""', "'''")


class Writer:
    """The dataclasses of all results, each behind those that it holds."""

    def __init__(self):
        self.shared = {**json_page.load("common")["$defs"], **json_page.load("envelope")["$defs"]}
        self.made, self.lines = {}, []  # made: the schema of each class

    def union(self, parts):
        parts = list(dict.fromkeys(parts))
        some = [part for part in parts if part != "None"]
        if not some:
            return "None"
        inner = some[0] if len(some) == 1 else f"Union[{', '.join(some)}]"
        return f"Optional[{inner}]" if "None" in parts else inner

    def type_of(self, schema, name):
        if "$ref" in schema:
            definition = schema["$ref"].rpartition("/")[2]
            return self.type_of(self.shared[definition], class_name(definition))
        if "anyOf" in schema:
            return self.union([self.type_of(one, name + str(at + 1) * (at > 0)) for at, one in enumerate(schema["anyOf"])])
        if "enum" in schema or "const" in schema:
            words = schema.get("enum", [schema.get("const")])
            return f"Literal[{', '.join('None' if word is None else json.dumps(word) for word in words)}]"
        kinds = schema.get("type", "any")
        return self.union([self.kind_of(schema, kind, name) for kind in (kinds if isinstance(kinds, list) else [kinds])])

    def kind_of(self, schema, kind, name):
        if kind == "array":
            return f"list[{self.type_of(schema['items'], name)}]" if "items" in schema else "list[Any]"
        if kind == "object":
            if schema.get("properties"):
                return self.dataclass(schema, schema.get("required", []), name, schema.get("description", ""))
            rest = schema.get("additionalProperties")
            return f"dict[str, {self.type_of(rest, name)}]" if isinstance(rest, dict) else "dict[str, Any]"
        return KINDS.get(kind, "Any")

    def dataclass(self, schema, required, name, words):
        if name in self.made:
            assert self.made[name] == schema, f"two classes would be called {name}"
            return name
        self.made[name] = schema
        members = [(key, self.type_of(one, name + class_name(key)), key in required, "" if key.endswith("_reason") else one.get("description", ""))
                   for key, one in schema["properties"].items()]
        body = []
        for key, kind, always, meaning in sorted(members, key=lambda member: not member[2]):
            kind = kind if always or kind.startswith("Optional[") or kind == "Any" else f"Optional[{kind}]"
            body.append(f"    {python_name(key)}: {kind}{'' if always else ' = None'}")
            body += [f'    """{sentence(meaning)}"""'] if meaning else []
        if "patternProperties" in schema:
            body += ["    more: dict[str, Any] = field(default_factory=dict)", '    """Members whose names depend on the cell."""']
        self.lines += ["", "", "@dataclass(frozen=True)", f"class {name}:"]
        self.lines += ([f'    """{sentence(words)}"""', ""] if words else []) + body
        return name


def verbs():
    return [path.stem for path in sorted(json_page.SCHEMAS.glob("*.json"))
            if path.stem not in (*json_page.SHARED, *FOR_EVER) and not path.stem.startswith(NOT_OF_PLUMB)]


def results_page():
    envelope = json_page.load("envelope")
    writer = Writer()
    problem = envelope["$defs"]["problem"]
    writer.dataclass(problem, problem["required"], "Problem", "A message: an error, a warning or a note.")
    file = envelope["properties"]["inputs"]["items"]
    writer.dataclass(file, file["required"], "InputFile", "A file that went in.")
    for verb in verbs():
        schema = json_page.load(verb)
        done = schema["then"]["properties"]["result"]
        always = set.intersection(*(set(form["required"]) for form in done.get("oneOf", [done])))
        writer.dataclass(schema["properties"]["result"], always, class_name(verb), f"Result of plumb {verb}: {schema['description']}")
    version = re.search(r'kVersion\[\] = "([^"]+)"', (SOURCE / "model_format/include/plumb/format/version.hpp").read_text())[1]
    return "\n".join([*HEAD, '"""What the verbs of plumb answer."""', "from __future__ import annotations", "",
                      "from dataclasses import dataclass, field", "from typing import Any, Literal, Optional, Union", "",
                      f'VERSION = "{version}"', *writer.lines, ""])


def verbs_page():
    lines = [*HEAD, '"""The verbs of plumb as methods."""', "from __future__ import annotations", "",
             "from typing import Optional, TypeVar", "", "from . import results", "from .answer import Answer, Option, Progress, Word", "",
             'Result = TypeVar("Result")', "", "", "class Verbs:",
             '    """Words are what stands behind the verb, options what begins with two dashes: held_out="kfold:5"."""', "",
             "    def _run(self, verb: str, words: tuple[Word, ...], options: dict[str, Option], kind: type[Result],",
             "             progress: Optional[Progress]) -> Answer[Result]:", "        raise NotImplementedError"]
    for verb in verbs():
        kind = f"results.{class_name(verb)}"
        lines += ["", f"    def {python_name(verb)}(self, *words: Word, progress: Optional[Progress] = None,",
                  f"            **options: Option) -> Answer[{kind}]:".replace("            ", " " * (9 + len(python_name(verb)))),
                  f'        """{sentence(json_page.load(verb)["description"])} Options: plumb {verb} --help"""',
                  f'        return self._run("{verb}", words, options, {kind}, progress)']
    return "\n".join([*lines, ""])


FILES = {PACKAGE / "results.py": results_page, PACKAGE / "verbs.py": verbs_page}

if __name__ == "__main__":
    for made, page in FILES.items():
        made.write_text(page())
