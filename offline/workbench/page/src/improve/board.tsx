// SPDX-License-Identifier: Apache-2.0
import { useEffect, useState } from "preact/hooks";
import { getJson } from "../api";
import { param, setParams } from "../hash";
import { mm } from "../numbers";
import { Card, Scroll } from "../parts/card";
import { Command } from "../parts/command";
import { cell, pick, poses, runNumber } from "../store";
import type { Poses } from "../types";

/** "joint_compliance, gear_ripple ×58" */
export function effectWords(effects: string[]): string {
  const counts = new Map<string, number>();
  for (const effect of effects) counts.set(effect, (counts.get(effect) ?? 0) + 1);
  return [...counts].map(([effect, n]) => (n > 1 ? `${effect} ×${n}` : effect)).join(", ") || "geometry";
}

export function Board() {
  const runs = [...(cell.value?.runs ?? [])].reverse();
  const against = Number(param("against"));
  return (
    <Card title="Model board" class="wide" lead="Held-out error only: poses that no fit saw, without single readings that stand out. The error of fitted poses is never accuracy.">
      <Scroll label="Runs">
        <table>
          <thead><tr><th scope="col">Run</th><th scope="col">Effects</th><th scope="col">n</th><th scope="col">Mean [mm]</th><th scope="col">95 % [mm]</th><th scope="col">Largest [mm]</th><th scope="col">Compare with</th></tr></thead>
          <tbody>
            {runs.map((row) => (
              <tr key={row.run} class={row.run === runNumber.value ? "picked" : ""}>
                <th scope="row"><button type="button" class="link" aria-pressed={row.run === runNumber.value} onClick={() => setParams({ run: row.run })}>{row.run}{row.current ? " (present)" : ""}</button></th>
                <td class="text">{row.damaged ? `cannot be read: ${row.damaged.message}` : effectWords(row.effects ?? [])}</td>
                <td class="n">{row.verdict_error?.n ?? 0}</td>
                <td class="n">{mm(row.verdict_error?.mean_mm)}</td>
                <td class="n">{mm(row.verdict_error?.p95_mm)}</td>
                <td class="n">{mm(row.verdict_error?.max_mm)}</td>
                <td>{row.run !== runNumber.value && !row.damaged && <button type="button" class="small" aria-pressed={row.run === against} aria-label={`Compare with run ${row.run}`} onClick={() => setParams({ against: row.run === against ? null : row.run })}>compare</button>}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </Scroll>
      <Command words={["runs"]} />
    </Card>
  );
}

const kMost = 10;

/** Held-out poses whose error grew from another run to the one that is looked at. */
export function Worse() {
  const now = poses.value, run = runNumber.value;
  const rows = (cell.value?.runs ?? []).filter((row) => !row.damaged);
  const asked = Number(param("against"));
  const earlier = rows.filter((row) => run !== null && row.run < run);
  const other = rows.some((row) => row.run === asked && row.run !== run) ? asked : earlier[earlier.length - 1]?.run;
  const [then, setThen] = useState<Poses | null>(null);
  useEffect(() => {
    setThen(null);
    if (other === undefined) return;
    const loading = new AbortController();
    getJson<Poses>(`/api/runs/${other}/poses`, loading.signal).then(setThen).catch(() => undefined);
    return () => loading.abort();
  }, [other]);
  if (other === undefined || !now || !then) return null;
  const before = new Map(then.row.map((row, i) => [row, then.after_norm_mm[i]]));
  const both = now.row.map((row, i) => ({ i, was: before.get(row) ?? null, is: now.after_norm_mm[i] }))
    .filter((p) => now.set[p.i] === "held" && p.was !== null && p.is !== null) as { i: number; was: number; is: number }[];
  const worse = both.filter(({ was, is }) => is > was).sort((a, b) => b.is - b.was - (a.is - a.was));
  return (
    <Card title="Poses that became worse" lead={`From run ${other} to run ${run}: ${worse.length} of ${both.length} held-out poses miss by more than before${worse.length > kMost ? `; the ${kMost} that grew most` : ""}.`}>
      {worse.length > 0 && (
        <Scroll label="Poses that became worse">
          <table>
            <thead><tr><th scope="col">Pose</th><th scope="col">Run {other} [mm]</th><th scope="col">Run {run} [mm]</th><th scope="col">More by [mm]</th></tr></thead>
            <tbody>{worse.slice(0, kMost).map(({ i, was, is }) => (
              <tr key={now.row[i]}><th scope="row"><button type="button" class="link" onClick={() => pick(i)}>{now.pose[i]}</button></th><td class="n">{mm(was)}</td><td class="n">{mm(is)}</td><td class="n">{mm(is - was)}</td></tr>
            ))}</tbody>
          </table>
        </Scroll>
      )}
      {run !== null && <Command words={["diff", String(Math.min(other, run)), String(Math.max(other, run))]} />}
    </Card>
  );
}
