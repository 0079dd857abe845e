#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Prints the schemas of docs/schemas as one page of tables: scripts/json-page > json.md"""
import json
import pathlib
import re

SCHEMAS = pathlib.Path(__file__).resolve().parents[2] / "docs/schemas"
SHARED = ("envelope", "common")


def beginning():
    """What holds for every schema, as the page of their folder says it."""
    return (SCHEMAS / "README.md").read_text().partition("## The files")[0]


def load(name):
    return json.loads((SCHEMAS / f"{name}.json").read_text())


def resolved(schema):
    """The schema behind a reference, and the name of the section that describes it."""
    if "$ref" not in schema:
        return schema, None
    file, _, pointer = schema["$ref"].partition("#")
    return None, (file.removesuffix(".json") or "envelope", pointer.rpartition("/")[2])


def words(schema):
    """The type of a member in words."""
    target = resolved(schema)[1]
    if target:
        return f"[{target[1]}](#{target[1]})"
    if "const" in schema:
        return f"`{json.dumps(schema['const'])}`"
    if "enum" in schema:
        return " ".join(f"`{json.dumps(word)}`" for word in schema["enum"])
    if "anyOf" in schema:
        return " or ".join(dict.fromkeys(words(one) for one in schema["anyOf"]))
    kinds = schema.get("type", "any")
    kinds = kinds if isinstance(kinds, list) else [kinds]
    if "array" in kinds and "items" in schema:
        size = f"{schema['maxItems']} " if schema.get("minItems") == schema.get("maxItems", -1) else ""
        many = f"array of {size}{words(schema['items'])}"
        kinds = [many if kind == "array" else kind for kind in kinds]
    return " or ".join(kinds)


def inner(schema):
    """The objects within a member, each with what it is reached by: "" or "[]"."""
    if schema.get("properties"):
        yield "", schema
    if "items" in schema:
        for path, one in inner(schema["items"]):
            yield "[]" + path, one
    for one in schema.get("anyOf", []):
        yield from inner(one)


def meaning(schema):
    """The page says once, at its beginning, where the reason of a null stands."""
    return re.sub(r"; null with the reason in \w+", "", schema.get("description", ""))


def rows(schema, required, path=""):
    for name, member in schema["properties"].items():
        if name.endswith("_reason") and name.removesuffix("_reason") in schema["properties"]:
            continue
        when = "" if name in required else "*optional*: "
        yield f"| `{path}{name}` | {words(member)} | {when}{meaning(member)} |"
        for step, one in inner(member):
            yield from rows(one, one.get("required", []), f"{path}{name}{step}.")
    for member in schema.get("patternProperties", {}).values():
        if "description" in member:
            yield f"| `{path}*` | {words(member)} | {member['description']} |"


def table(schema, required, path=""):
    return ["| member | type | meaning |", "|---|---|---|", *rows(schema, required, path)]


def section(name):
    """One verb: its forms, and the members of its result."""
    schema = load(name)
    result = schema["properties"]["result"]
    done = schema["then"]["properties"]["result"]
    forms = done.get("oneOf", [done])
    always = set.intersection(*(set(form["required"]) for form in forms))
    out = [f"### {schema['title']}", "", f"{schema['description']} Schema: [{name}.json](schemas/{name}.json).", ""]
    if len(forms) > 1:
        out += ["Its members depend on what was asked for:", ""]
        out += [f"* {form['title']}: " + ", ".join(f"`{word}`" for word in form["required"]) for form in forms]
        out.append("")
    return out + table(result, always) + [""]


def page():
    names = sorted(path.stem for path in SCHEMAS.glob("*.json") if path.stem not in SHARED)
    envelope, common = load("envelope"), load("common")
    out = [beginning().rstrip("\n"), "", "## The object", "", "Schema: [envelope.json](schemas/envelope.json).", ""]
    out += table(envelope, envelope["required"]) + ["", "## What several verbs share", "",
                                                    "Schema: [common.json](schemas/common.json).", ""]
    for name, one in {"problem": envelope["$defs"]["problem"], **common["$defs"]}.items():
        out += [f"### {name}", ""] + ([one["description"], ""] if "description" in one else [])
        if one.get("properties"):
            out += table(one, one.get("required", [])) + [""]
        else:
            keys = ", ".join(f"`{word}`" for word in one.get("propertyNames", {}).get("enum", []))
            out += [f"Names: {keys}.", ""]
    for program, prefix in (("plumb", ""), ("plumb-rt", "rt-"), ("plumb-twin", "twin-")):
        out += [f"## {program}", "", "The tables list the members of `result`.", ""]
        for name in names:
            of = "rt-" if name.startswith("rt-") else "twin-" if name.startswith("twin-") else ""
            if of == prefix:
                out += section(name)
    return "\n".join(out).rstrip("\n") + "\n"


if __name__ == "__main__":
    print(page(), end="")
