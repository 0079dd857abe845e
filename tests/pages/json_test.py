#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Holds what the programs print with --json against docs/schemas, and the page of the schemas against them.

usage: json_test.py FOLDER   the folder of plumb, plumb-rt and plumb-twin
Needs the Debian packages python3-jsonschema and python3-numpy.
"""
import collections
import copy
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import warnings

warnings.simplefilter("ignore", DeprecationWarning)  # newer versions of the package prefer another resolver
try:
    import jsonschema
except ModuleNotFoundError:
    sys.exit("error: the Python module jsonschema is missing\n  = help: scripts/install-deps")

import json_page
import kept_whole
import outputs
import python_types

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(SOURCE / "offline/python"))
try:
    from plumb import answer, results
except ModuleNotFoundError:
    sys.exit("error: the Python module numpy is missing\n  = help: scripts/install-deps")

SCHEMAS = SOURCE / "docs/schemas"
PROGRAMS = pathlib.Path(sys.argv[1]).resolve()
SHARED = {"envelope", "common"}
# What plumb-rt replays is a record of a CAN bus, which a test machine need not have.
NOT_DONE_HERE = {"rt-replay", "serve"}  # serve ends with a signal: tests/workbench/faults


def validator(name):
    file = SCHEMAS / f"{name}.json"
    schema = json.loads(file.read_text())
    jsonschema.Draft202012Validator.check_schema(schema)
    resolver = jsonschema.RefResolver(file.as_uri(), schema)
    return jsonschema.Draft202012Validator(schema, resolver=resolver)


def innermost(error):
    return [leaf for one in error.context for leaf in innermost(one)] if error.context else [error]


def faults(check, value):
    return [f"{'.'.join(map(str, leaf.absolute_path))}: {leaf.message[:200]}"
            for error in check.iter_errors(value) for leaf in innermost(error)[:5]]


def objects(value, path=()):
    """Every object within a value, with the way to it; of an array the first one."""
    if isinstance(value, dict):
        yield path
        for key, inner in value.items():
            yield from objects(inner, (*path, key))
    elif isinstance(value, list) and value:
        yield from objects(value[0], (*path, 0))


def at(value, path):
    for step in path:
        value = value[step]
    return value


class Json(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        names = {path.stem for path in SCHEMAS.glob("*.json")}
        cls.check = {name: validator(name) for name in names}
        with tempfile.TemporaryDirectory() as scratch:
            cls.printed = outputs.everything(PROGRAMS, scratch)

    def schema_of(self, printed):
        """Where no verb was understood, only the envelope is promised."""
        name = printed.schema_name()
        return self.check["envelope" if name == printed.words[0] else name]

    def test_what_the_programs_print_is_what_the_schemas_say(self):
        for printed in self.printed:
            with self.subTest(printed.command):
                self.assertEqual(faults(self.schema_of(printed), printed.json), [], printed.command)

    def test_the_exit_code_stands_in_the_object(self):
        for printed in self.printed:
            with self.subTest(printed.command):
                self.assertEqual(printed.json["ok"], printed.code == 0)
                if printed.code != 0:
                    self.assertEqual(printed.json["error"]["exit"], printed.code)

    def test_every_verb_has_a_schema_and_was_run(self):
        verbs = set()
        for program in ("plumb", "plumb-rt", "plumb-twin"):
            text = subprocess.run([PROGRAMS / program, "--help"], capture_output=True, text=True, check=True).stdout
            prefix = program.removeprefix("plumb").lstrip("-")
            for verb in re.findall(r"(?m)^  (\S+)  ", text.partition("\nVerbs:\n")[2]):
                verbs.add(f"{prefix}-{verb}" if prefix else verb)
        self.assertEqual(verbs, set(self.check) - SHARED)
        done = {printed.schema_name() for printed in self.printed if printed.json["ok"]}
        self.assertEqual(verbs - done - NOT_DONE_HERE, set())

    def test_every_sort_of_failure_was_seen(self):
        codes = collections.Counter(printed.code for printed in self.printed)
        self.assertLessEqual({0, 1, 2, 3, 4, 5}, set(codes))

    def test_a_member_too_many_is_refused_everywhere(self):
        """Planted violations: in every object that a verb prints."""
        for printed in self.first_of_each():
            for path in objects(printed.json):
                if path[-1:] == ("options",):
                    continue  # the options of effects are named by cell.toml
                wrong = copy.deepcopy(printed.json)
                at(wrong, path)["no_such_member"] = 1
                self.assertFalse(self.schema_of(printed).is_valid(wrong), f"{printed.command}: {path}")

    def test_a_missing_member_of_a_result_is_refused(self):
        for printed in self.first_of_each():
            required = [form["required"] for form in self.forms(printed.schema_name())]
            for member in set.intersection(*map(set, required)):
                wrong = copy.deepcopy(printed.json)
                del wrong["result"][member]
                self.assertFalse(self.schema_of(printed).is_valid(wrong), f"{printed.command}: {member}")

    def test_a_null_without_its_reason_is_refused(self):
        fit = next(one for one in self.printed if one.schema_name() == "fit" and one.json["ok"])
        wrong = copy.deepcopy(fit.json)
        wrong["result"]["held_out"]["mean_mm"] = None
        self.assertFalse(self.check["fit"].is_valid(wrong))
        wrong["result"]["held_out"]["mean_mm_reason"] = "no pose belongs to this set"
        self.assertTrue(self.check["fit"].is_valid(wrong))

    def test_the_types_of_the_python_package_keep_every_result_whole(self):
        seen = set()
        for printed in self.printed:
            verb = printed.schema_name()
            if printed.json["ok"] and verb in python_types.verbs():
                seen.add(verb)
                made = answer.answer_of(printed.json, getattr(results, python_types.class_name(verb)), None)
                self.assertEqual(list(kept_whole.lost(made.result, printed.json["result"])), [], printed.command)
        self.assertEqual(seen, set(python_types.verbs()))

    def test_the_page_has_every_schema_and_every_section_it_links(self):
        page = json_page.page()
        for name in self.check:
            self.assertIn(f"](schemas/{name}.json)", page)
        headings = set(re.findall(r"(?m)^### (.+)$", page))
        self.assertEqual(set(re.findall(r"\]\(#([^)]+)\)", page)) - headings, set())

    def first_of_each(self):
        seen = set()
        for printed in self.printed:
            if printed.json["ok"] and printed.schema_name() not in seen:
                seen.add(printed.schema_name())
                yield printed

    def forms(self, name):
        done = self.check[name].schema["then"]["properties"]["result"]
        return done.get("oneOf", [done])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
