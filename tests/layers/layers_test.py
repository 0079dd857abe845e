#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every #include of every room is one that the table of docs/architecture.md allows, the table names the rooms, and no
files include each other in a circle."""
import pathlib
import re
import tempfile
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
HALVES = ("model_format", "runtime", "drivers", "offline")
# Where the build looks for the headers of our own.
ROOTS = ("model_format/include", "runtime/include", "drivers/include", "drivers", "offline")
OWN_PARTS = ("include", "src")  # of a room, no rooms of their own
GENERATED = {"model_generated.h": "model_format"}
STANDARD_C = {"stdbool.h", "stddef.h", "stdint.h"}
LIBRARIES = {"CLI": "CLI11", "Eigen": "Eigen", "boost": "Boost", "ceres": "Ceres", "console_bridge": "urdfdom", "fmt": "fmt", "glog": "Ceres",
             "modbus": "libmodbus", "nlohmann": "JSON", "openssl": "OpenSSL", "sodium.h": "libsodium", "toml++": "toml++",
             "urdf_model": "urdfdom", "urdf_parser": "urdfdom"}


class Room:
    def __init__(self, cells):
        self.folder, self.owns, rooms, libraries = cells
        self.folder = self.folder.strip("`")
        self.rooms = re.findall(r"`([^`]+)`", rooms)
        self.libraries = libraries.split()


def table(source):
    """The rows of the table of rooms, in their order."""
    page = (source / "docs/architecture.md").read_text()
    body = page.partition("| folder | owns | may include |")[2].partition("\n\n")[0]
    rows = [line for line in body.splitlines() if line.startswith("| `")]
    return [Room([cell.strip() for cell in row.strip("|").split("|")]) for row in rows]


def room_of(path, names):
    """The room of a path from the top: the longest name that it begins with."""
    within = [name for name in names if path == name or path.startswith(name + "/")]
    return max(within, key=len, default=None)


def files_of(source):
    for half in HALVES:
        for path in sorted((source / half).rglob("*")):
            if path.suffix in (".c", ".cpp", ".h", ".hpp"):
                yield path.relative_to(source)


def includes_of(path):
    """Pairs of the line's number and of what stands in quotes or angle brackets."""
    for number, line in enumerate(path.read_text().splitlines(), 1):
        found = re.match(r'\s*#\s*include\s*([<"])([^>"]+)[>"]', line)
        if found:
            yield number, found[1] == '"', found[2]


def header_of(source, path, name):
    """The header of our own that a file includes by that name, as a path from the top; None if there is none."""
    for folder in (path.parent, *map(pathlib.Path, ROOTS)):
        header = (source / folder / name).resolve()
        if header.is_file() and header.is_relative_to(source):
            return header.relative_to(source)
    return None


def header_room(source, path, name, names):
    """The room of a header of our own; None if it is of nobody here."""
    if name in GENERATED:
        return GENERATED[name]
    header = header_of(source, path, name)
    return header and room_of(header.as_posix(), names)


def library_of(name):
    """"Linux" of POSIX and kernel headers; None of the C++ standard library; else who it belongs to."""
    first, _, rest = name.partition("/")
    if name in LIBRARIES or rest and first in LIBRARIES:
        return LIBRARIES[first]
    if name in STANDARD_C or not (rest or name.endswith(".h")):
        return None
    return "Linux"


def violations(source):
    """One sentence for each include that the table does not allow."""
    rooms = {room.folder: room for room in table(source)}
    out = []
    for path in files_of(source):
        room = rooms.get(room_of(path.as_posix(), rooms))
        if room is None:
            out.append(f"{path}: it lies in no room of docs/architecture.md")
            continue
        for line, quoted, name in includes_of(source / path):
            other = header_room(source, path, name, rooms) if quoted else None
            if quoted and other is None:
                out.append(f"{path}:{line}: no header of ours is called {name}")
            elif quoted and other != room.folder and other not in room.rooms:
                out.append(f"{path}:{line}: {room.folder} may not include {other} ({name})")
            elif not quoted and (library := library_of(name)) and library not in room.libraries:
                out.append(f"{path}:{line}: {room.folder} may not include {library} ({name})")
    return out


def unit_of(path):
    """A header and the source of the same name count as one: NAME.hpp and NAME.cpp, also include/.../NAME.hpp and
    src/NAME.cpp of a room."""
    found = re.fullmatch(r"(.*?)(?:/(src|include/plumb(?:/\w+(?=/))?))?((?:/\w+)+)", path.with_suffix("").as_posix())
    room, own, name = found.groups()
    return room + (name.replace("/detail/", "/") if own else name)


def included_units(source):
    """For each unit the others that its files include."""
    out = {}
    for path in files_of(source):
        of = out.setdefault(unit_of(path), set())
        for _, quoted, name in includes_of(source / path):
            header = header_of(source, path, name) if quoted else None
            if header and unit_of(header) != unit_of(path):
                of.add(unit_of(header))
    return out


def way_back(included, start):
    """The shortest way along includes from a unit to itself, with it at both ends; None if there is none."""
    before, reached = {}, [start]
    for unit in reached:
        for other in sorted(included.get(unit, ())):
            if other == start:
                way = [unit, start]
                while way[0] != start:
                    way.insert(0, before[way[0]])
                return way
            if other not in before:
                before[other] = unit
                reached.append(other)
    return None


def circles(source):
    """One sentence for each circle of units, shortest ways only, of which no two share a unit."""
    included, named, out = included_units(source), set(), []
    ways = filter(None, (way_back(included, unit) for unit in sorted(included)))
    for way in sorted(ways, key=len):
        if named.isdisjoint(way):
            named.update(way)
            out.append(f"files include each other in a circle: {' -> '.join(way)}; move what they share, such as a plain "
                       "type or a helper, to a file of its own that both include")
    return out


def folders(source):
    """Every folder that must be a room: the halves that are one themselves, and what lies in any half."""
    out = {half for half in HALVES if any(path.parts[1] in OWN_PARTS for path in files_of(source) if path.parts[0] == half)}
    for path in files_of(source):
        if path.parts[1] not in OWN_PARTS and len(path.parts) > 2:
            out.add("/".join(path.parts[:2]))
    return out


class Layers(unittest.TestCase):

    def test_every_include_is_one_that_the_table_allows(self):
        found = violations(SOURCE)
        self.assertEqual(found, [], "\n" + "\n".join(found))

    def test_no_files_include_each_other_in_a_circle(self):
        found = circles(SOURCE)
        self.assertEqual(found, [], "\n" + "\n".join(found))

    def test_the_table_names_every_folder_once_and_nothing_else(self):
        named = [room.folder for room in table(SOURCE)]
        self.assertEqual(len(named), len(set(named)))
        self.assertEqual(set(named), folders(SOURCE))

    def test_a_room_is_allowed_only_rooms_above_it(self):
        above = set()
        for room in table(SOURCE):
            self.assertLessEqual(set(room.rooms), above, room.folder)
            above.add(room.folder)

    def test_nothing_is_allowed_that_is_not_included(self):
        used = {}
        rooms = {room.folder: room for room in table(SOURCE)}
        for path in files_of(SOURCE):
            of = used.setdefault(room_of(path.as_posix(), rooms), set())
            for _, quoted, name in includes_of(SOURCE / path):
                of.add(header_room(SOURCE, path, name, rooms) if quoted else library_of(name))
        for room in rooms.values():
            self.assertLessEqual({*room.rooms, *room.libraries}, used[room.folder], room.folder)


class Planted(unittest.TestCase):
    """The rules catch what they are for, in a small tree of folders with one fault each."""
    TABLE = ("| folder | owns | may include | libraries |\n|---|---|---|---|\n"
             "| `model_format` | files | | |\n| `offline/fit` | fits | `model_format` | Eigen |\n")

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.source = pathlib.Path(folder.name).resolve()
        self.write("docs/architecture.md", self.TABLE)
        self.write("model_format/include/plumb/format/model.hpp", "#include <string>\n")
        self.write("offline/fit/fit.cpp", '#include <Eigen/Core>\n#include "plumb/format/model.hpp"\n')

    def write(self, name, text):
        path = self.source / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def test_a_tree_without_fault_passes(self):
        self.assertEqual(violations(self.source), [])
        self.assertEqual(folders(self.source), {"model_format", "offline/fit"})

    def test_an_include_of_a_room_that_is_not_allowed_is_found(self):
        self.write("offline/fit/fit.hpp", "")
        self.write("model_format/src/reader.cpp", '#include <vector>\n  #  include "fit/fit.hpp"\n')
        self.assertEqual(violations(self.source),
                         ["model_format/src/reader.cpp:2: model_format may not include offline/fit (fit/fit.hpp)"])

    def test_a_way_round_through_the_parent_folder_is_found(self):
        self.write("offline/fit/fit.hpp", "")
        self.write("model_format/src/reader.cpp", '#include "../../offline/fit/fit.hpp"\n')
        self.assertEqual(len(violations(self.source)), 1)

    def test_a_header_of_linux_that_is_not_allowed_is_found(self):
        self.write("offline/fit/fit.cpp", "#include <sys/stat.h>\n#include <unistd.h>\n#include <stdint.h>\n")
        self.assertEqual(len(violations(self.source)), 2)

    def test_a_library_that_is_not_allowed_is_found(self):
        self.write("model_format/src/reader.cpp", "#include <nlohmann/json.hpp>\n")
        self.assertEqual(len(violations(self.source)), 1)

    def test_a_circle_of_files_is_found_and_named(self):
        self.write("offline/guess/guess.hpp", "")
        self.write("offline/guess/guess.cpp", '#include "guess/guess.hpp"\n#include "guess/trial.hpp"\n')
        self.write("offline/guess/trial.hpp", '#include "guess/sum.hpp"\n')
        self.assertEqual(circles(self.source), [])
        self.write("offline/guess/sum.cpp", "")
        self.write("offline/guess/sum.hpp", '#include "guess/guess.hpp"\n')
        found = circles(self.source)
        self.assertEqual(len(found), 1)
        self.assertIn("offline/guess/guess -> offline/guess/trial -> offline/guess/sum -> offline/guess/guess;", found[0])
        self.assertIn("to a file of its own", found[0])

    def test_a_circle_through_the_source_of_a_public_header_is_found(self):
        self.write("model_format/include/plumb/format/bounds.hpp", '#include "plumb/format/model.hpp"\n')
        self.assertEqual(circles(self.source), [])
        self.write("model_format/src/model.cpp", '#include "plumb/format/bounds.hpp"\n')
        self.assertEqual(len(circles(self.source)), 1)

    def test_a_folder_that_is_no_row_is_found(self):
        self.write("offline/guess/guess.cpp", "")
        self.assertEqual(len(violations(self.source)), 1)
        self.assertIn("offline/guess", folders(self.source))


if __name__ == "__main__":
    unittest.main()
