#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the types of results that the page of the workbench shows, from docs/schemas: tests/pages/page_types.py"""
import json
import pathlib

import json_page

FILE = pathlib.Path(__file__).resolve().parents[2] / "offline/workbench/page/src/results.ts"
KINDS = {"integer": "number"}
SHORT = 100  # characters: an object up to this stands on one line


def kind_of(schema, kind):
    if kind == "array":
        inner = type_of(schema["items"]) if "items" in schema else "unknown"
        return f"({inner})[]" if " | " in inner and not inner.startswith("{") else inner + "[]"
    if kind == "object":
        return braces(schema, schema.get("required", [])) if schema.get("properties") else "Record<string, unknown>"
    return KINDS.get(kind, kind)


def name_of(definition):
    """noise_floor -> NoiseFloor"""
    return "".join(word.capitalize() for word in definition.split("_"))


def type_of(schema):
    if "$ref" in schema:
        return name_of(schema["$ref"].rpartition("/")[2])
    if "anyOf" in schema:
        return " | ".join(type_of(one) for one in schema["anyOf"])
    if "enum" in schema:
        return " | ".join(json.dumps(word) for word in schema["enum"])
    kinds = schema["type"] if isinstance(schema["type"], list) else [schema["type"]]
    return " | ".join(kind_of(schema, kind) for kind in kinds)


def braces(schema, required):
    """Without the reasons of what is null, which the page does not show."""
    members = [f"{name}{'' if name in required else '?'}: {type_of(one)}"
               for name, one in schema["properties"].items() if not name.endswith("_reason")]
    short = "{ " + "; ".join(members) + " }"
    if len(short) < SHORT and "\n" not in short:
        return short
    return "{\n" + "".join("  " + member.replace("\n", "\n  ") + ";\n" for member in members) + "}"


def page():
    shared = json_page.load("common")["$defs"]
    diagnose = json_page.load("diagnose")
    required = diagnose["then"]["properties"]["result"]["required"]
    return "\n".join([
        "// SPDX-License-Identifier: Apache-2.0",
        "// Made from docs/schemas by tests/pages/page_types.py; do not edit.", "",
        *(line for name in ("statistics", "finding", "noise_floor", "blocks")
          for line in (f"export type {name_of(name)} = {type_of(shared[name])};", "")),
        "export interface Diagnosis " + braces(diagnose["properties"]["result"], required), ""])


if __name__ == "__main__":
    FILE.write_text(page())
