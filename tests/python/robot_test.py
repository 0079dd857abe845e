#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""plumb.Robot gives the bits of plumb predict and plumb correct, for every sample cell, and refuses wrong arrays.

usage: robot_test.py PROGRAM LIBRARY
"""
import concurrent.futures
import csv
import os
import re

from support import SOURCE, Case, demos, main, np, plumb, printed

UNITS = {"deg": np.pi / 180.0, "rad": 1.0, "mm": 1e-3, "m": 1.0}


def columns(file):
    with open(file, encoding="utf-8", newline="") as lines:
        rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    return {name: [row[name] for row in rows] for name in rows[0]}


def numbers(table, *names):
    return np.array([[float(word) for word in table[name]] for name in names]).T


def joint_names(table):
    return [name for name in table if re.fullmatch(r"q[0-9]+_(deg|mm)", name)]


def in_si(table):
    """The same table with joints in rad or m and positions in m, which are read without rounding; and its joints."""
    out, joints = {}, []
    for name, values in table.items():
        word, _, unit = name.rpartition("_")
        if name in joint_names(table) or word in ("x", "y", "z"):
            si = [float(value) * UNITS[unit] for value in values]
            out[f"{word}_{'rad' if unit == 'deg' else 'm'}"] = [repr(value) for value in si]
            if word[0] == "q":
                joints.append(si)
        else:
            out[name] = values
    return out, np.array(joints).T


def write(file, table):
    with open(file, "w", encoding="utf-8", newline="") as lines:
        writer = csv.writer(lines)
        writer.writerow(table)
        writer.writerows(zip(*table.values()))


def context(table, robot):
    """What the columns of a table tell the robot beside the joints."""
    count, out = len(next(iter(table.values()))), {}
    if "payload_kg" in table:
        out["payload_kg"] = numbers(table, "payload_kg")[:, 0]
    if "t_s" in table:
        out["time_s"] = numbers(table, "t_s")[:, 0]
    temperatures = {name: numbers(table, f"{name}_degC")[:, 0] for name in robot.temperatures if f"{name}_degC" in table}
    if temperatures:
        out["temperature_degC"] = temperatures
    for ours, name in (("direction", "dir_j{}"), ("travel", "travel_j{}_deg")):
        given = np.full((count, robot.joints), np.nan)
        for joint in range(robot.joints):
            if name.format(joint + 1) in table:
                given[:, joint] = numbers(table, name.format(joint + 1))[:, 0] * (UNITS["deg"] if ours == "travel" else 1.0)
        out[ours] = given
    return out


class Bits(Case):

    def model(self, name):
        cell = self.demo(name)
        cell.fit()
        if not name.startswith("planar"):  # 1536 poses
            cell.diagnose(apply=True)
        cell.compile(force=True)
        return cell, plumb.Robot.load(cell.folder / "robot.plumb")

    def same(self, T, status, file, columns_of, statuses):
        """T in millimetres as the file has it, and the words of its statuses."""
        found = columns(file)
        self.assertEqual(plumb.Prediction(T, status).status_text, found["status"])
        self.assertEqual((T[:, :3, 3] * 1e3).tolist(), numbers(found, *columns_of[:3]).tolist())
        w, x, y, z = numbers(found, *columns_of[3:]).T
        R = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                      [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                      [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]).transpose(2, 0, 1)
        np.testing.assert_allclose(T[:, :3, :3], R, rtol=0, atol=1e-12)  # the file has quaternions
        statuses.update(found["status"])

    def test_are_those_of_predict_and_correct(self):
        statuses, told = set(), set()
        for name in demos():
            with self.subTest(name):
                cell, robot = self.model(name)
                model, data, out = cell.folder / "robot.plumb", cell.folder / "si.csv", cell.folder / "out.csv"
                table, q = in_si(columns(cell.folder / "measurements.csv"))
                write(data, table)
                cell.predict(model, data=data, output=out)
                known = context(table, robot)
                told.update(known)
                predicted = robot.predict(q, **known)
                self.same(predicted.T, predicted.status, out, ("px_mm", "py_mm", "pz_mm", "pqw", "pqx", "pqy", "pqz"), statuses)

                table, seed = in_si(columns(cell.folder / "targets.csv"))
                write(data, table)
                cell.correct(model, data=data, output=out, force=True)
                T = plumb.poses(numbers(table, "x_m", "y_m", "z_m"), numbers(table, "qw", "qx", "qy", "qz"))
                corrected = robot.correct(T, seed, **context(table, robot))
                self.same(corrected.T, corrected.status, out, ("cx_mm", "cy_mm", "cz_mm", "cqw", "cqx", "cqy", "cqz"), statuses)
                ok = corrected.status == 0
                there = robot.predict(corrected.q, **context(table, robot))
                self.assertLess(np.abs(there.T - T)[ok, :3, 3].max(initial=0.0), 1e-6)
        self.assertLessEqual({"ok", "limited", "context-fallback", "not-converged"}, statuses)
        self.assertLessEqual({"temperature_degC", "direction"}, told)

    def test_do_not_depend_on_threads_or_on_parts(self):
        cell, robot = self.model("mixed")
        rows, q = in_si(columns(cell.folder / "targets.csv"))
        many = np.tile(q, (100_000 // len(q), 1))
        T = np.tile(robot.predict(q).T, (len(many) // len(q), 1, 1))
        together = robot.correct(T, many)
        alone = robot.correct(T[:len(q)], q)
        self.assertTrue((together.T == np.tile(alone.T, (len(many) // len(q), 1, 1))).all())
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            part = 25_000
            for one in pool.map(lambda _: robot.correct(T[:part], many[:part]), range(4)):
                self.assertTrue((one.T == together.T[:part]).all() and (one.status == together.status[:part]).all())


class Wrong(Case):

    def setUp(self):
        super().setUp()
        self.model = SOURCE / "tests/format/golden/planar_2r.plumb"
        self.robot = plumb.Robot.load(self.model)
        self.q = np.array([[0.1, 0.9], [0.2, 0.8], [0.3, 0.8]])

    def refused(self, words, call, *arguments, kind=ValueError, **named):
        with self.assertRaisesRegex(kind, words):
            call(*arguments, **named)

    def test_shapes(self):
        T = self.robot.predict(self.q).T
        self.refused(r"q has the shape \(3, 3\): the arm has 2 joints, so give \(N, 2\)", self.robot.predict, np.zeros((3, 3)))
        self.refused(r"q has the shape \(2,\)", self.robot.predict, self.q[0])
        self.refused(r"seed has the shape \(2, 3\)", self.robot.correct, T, self.q.T)
        self.refused(r"T has the shape \(2, 4, 4\): with 3 rows of seed give \(3, 4, 4\)", self.robot.correct, T[:2], self.q)
        self.refused(r"payload_kg has the shape \(2,\): give \(3,\)", self.robot.predict, self.q, payload_kg=[1.0, 2.0])

    def test_numbers_that_are_none(self):
        self.q[2, 1] = np.nan
        self.refused("row 2 of q holds NaN", self.robot.predict, self.q)
        T = self.robot.predict(self.q[:2]).T
        T[1, 0, 3] = np.inf
        self.refused("row 1 of T holds NaN or an infinite", self.robot.correct, T, self.q[:2])
        T[1] = T[0].T
        self.refused("last row of each matrix", self.robot.correct, T, self.q[:2])
        self.refused("quaternion of row 0 has length 2, not 1", plumb.poses, [[0, 0, 0]], [[0, 0, 0, 2]])

    def test_a_matrix_that_is_no_rotation_is_refused_alone(self):
        T = self.robot.predict(self.q).T
        T[1, :3, :3] *= 2.0
        found = self.robot.correct(T, self.q)
        self.assertEqual(found.status_text, ["ok", "not-finite", "ok"])
        self.assertEqual(found.refused.tolist(), [False, True, False])

    def test_what_is_known(self):
        self.refused("'payload' is not known: give payload_kg, ", self.robot.predict, self.q, kind=TypeError, payload=1.0)
        self.refused("no sensor 'temp_arm', but: none", self.robot.predict, self.q, temperature_degC={"temp_arm": 20.0})
        self.refused("dict of sensor and values", self.robot.predict, self.q, kind=TypeError, temperature_degC=20.0)
        self.refused("belongs to a payload", self.robot.predict, self.q, payload_com_m=[0, 0, 0])

    def test_an_unloaded_robot(self):
        with self.robot as robot:
            robot.predict(self.q)
        self.refused("this robot is unloaded: load it again with plumb.Robot.load", self.robot.predict, self.q)
        self.robot.unload()

    def test_files_that_are_no_models(self):
        for file, code in ((self.folder / "none.plumb", "PLUMB_UNREADABLE"), (SOURCE / "README.md", "PLUMB_UNREADABLE")):
            with self.assertRaises(plumb.PlumbError) as caught:
                plumb.Robot.load(file)
            self.assertEqual((caught.exception.code, caught.exception.exit_code, caught.exception.place), (code, 3, str(file)))
        with self.assertRaisesRegex(plumb.PlumbError, "PLUMB_OTHER_ROBOT: the model was made for serial"):
            plumb.Robot.load(self.model, serial="another")

    def test_a_missing_library_is_named_with_its_remedy(self):
        kept = os.environ["PLUMB_LIBRARY"]
        self.addCleanup(plumb.library.library.cache_clear)
        self.addCleanup(os.environ.__setitem__, "PLUMB_LIBRARY", kept)
        plumb.library.library.cache_clear()
        os.environ["PLUMB_LIBRARY"] = "no-such-library.so"
        self.refused("'no-such-library.so' cannot be loaded .*libplumb0.*PLUMB_LIBRARY", plumb.Robot.load, self.model,
                     kind=FileNotFoundError)

    def test_no_rows(self):
        self.assertEqual(self.robot.predict(np.zeros((0, 2))).T.shape, (0, 4, 4))
        self.assertEqual(self.robot.correct(np.zeros((0, 4, 4)), np.zeros((0, 2))).q.shape, (0, 2))


class Header(Case):
    """The binding is that of the header."""
    TEXT = (SOURCE / "runtime/include/plumb.h").read_text()

    def test_numbers(self):
        from plumb import library
        self.assertIn(f"#define PLUMB_MEASURED UINT32_C({library.MEASURED})", self.TEXT)
        self.assertIn(f"#define PLUMB_COMMANDED UINT32_C({library.COMMANDED})", self.TEXT)
        self.assertIn(f"#define PLUMB_MAX_TEMPERATURES {library.MAX_TEMPERATURES}\n", self.TEXT)
        results = re.findall(r"PLUMB_([A-Z_]+) = ([0-9]+)", self.TEXT.partition("typedef enum plumb_result")[2].partition("}")[0])
        self.assertEqual([(name, str(at)) for at, name in enumerate(library.RESULTS)], results)

    def test_members_of_the_struct(self):
        from plumb import library
        body = re.sub(r"/\*.*?\*/", "", self.TEXT.partition("typedef struct plumb_rows {")[2].partition("}")[0], flags=re.S)
        kinds = {"uint32_t": library.c_uint32, "uint64_t": library.c_uint64, "const double*": library.Doubles}
        self.assertEqual([(name, kinds[kind]) for kind, name in re.findall(r"(\S+|const double\*) (\w+);", body)],
                         library.Rows._fields_)


if __name__ == "__main__":
    main()
