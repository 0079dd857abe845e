// SPDX-License-Identifier: Apache-2.0
// Frames of an arm from the joints table of a cell.toml; good enough to look at.
const number = (row, key) => Number(new RegExp(`\\b${key} = (-?[\\d.]+)`).exec(row)?.[1] ?? 0);

const rowsOf = (toml) => toml.split("\n").filter((line) => /^\s*\{ name = "/.test(line));

export const jointsOf = (toml) => rowsOf(toml).map((row) => {
  const slides = row.includes("prismatic"), [, lower, upper] = /\bq = \[([^,]+),([^\]]+)\]/.exec(row) ?? [];
  return { name: /name = "([^"]+)"/.exec(row)[1], type: slides ? "prismatic" : "revolute", unit: slides ? "mm" : "deg", lower: Number(lower), upper: Number(upper) };
});

const times = (a, b) => a.map((row) => b[0].map((_, j) => row.reduce((sum, x, k) => sum + x * b[k][j], 0)));
const turn = (axis, deg) => {
  const c = Math.cos(deg * Math.PI / 180), s = Math.sin(deg * Math.PI / 180);
  return axis === "x" ? [[1, 0, 0, 0], [0, c, -s, 0], [0, s, c, 0], [0, 0, 0, 1]] : [[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]];
};
const move = (x, z) => [[1, 0, 0, x], [0, 1, 0, 0], [0, 0, 1, z], [0, 0, 0, 1]];

export function armAt(toml, q) {
  const modified = /dh_convention = "modified"/.test(toml), joints = jointsOf(toml);
  let pose = move(0, 0);
  const poses = [pose];
  rowsOf(toml).forEach((row, j) => {
    const slides = joints[j].type === "prismatic";
    const along = times(turn("z", number(row, "theta") + (slides ? 0 : q[j])), move(0, number(row, "d") + (slides ? q[j] : 0)));
    const across = times(move(number(row, "a"), 0), turn("x", number(row, "alpha")));
    pose = times(pose, modified ? times(across, along) : times(along, across));
    poses.push(pose);
  });
  poses.push(times(pose, move(0, Number(/tool = \{ xyz = \[[^,]*,[^,]*, *([-\d.]+)/.exec(toml)?.[1] ?? 0))));
  return {
    origins_mm: poses.map((p) => [p[0][3], p[1][3], p[2][3]]),
    axes: poses.map((p) => [0, 1, 2].map((k) => [p[0][k], p[1][k], p[2][k]])),
  };
}
