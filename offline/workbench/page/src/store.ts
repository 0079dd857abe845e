// SPDX-License-Identifier: Apache-2.0
// The cell, the run that is looked at, its poses, and the pose that is picked. Everything that the
// screens share.
import { computed, effect, signal } from "@preact/signals";
import { getJson, problemOf } from "./api";
import { connection } from "./connection";
import { param, setParams } from "./hash";
import { recall, told } from "./jobs";
import { listen } from "./socket";
import type { Cell, Job, Poses, Problem, RunDetail } from "./types";

export const cell = signal<Cell | null>(null);
export const cellProblem = signal<Problem | null>(null);
export const runDetail = signal<RunDetail | null>(null);
export const poses = signal<Poses | null>(null);
export const runProblem = signal<Problem | null>(null);

export const joints = computed(() => cell.value?.cell?.joints ?? []);
export const command = computed(() => cell.value?.command ?? "plumb");
export const state = computed(() => cell.value?.state ?? 0);

/** The run that is looked at: the one of the address if it exists, else the present one, else the last. */
export const runNumber = computed<number | null>(() => {
  const known = (cell.value?.runs ?? []).filter((run) => !run.damaged);
  const asked = Number(param("run"));
  if (known.some((run) => run.run === asked)) return asked;
  return cell.value?.current_run ?? known[known.length - 1]?.run ?? null;
});

export const runRow = computed(() => cell.value?.runs.find((run) => run.run === runNumber.value) ?? null);

/** Indices of the poses, largest error first; those without an error last. */
export const worstFirst = computed<number[]>(() => {
  const all = poses.value;
  if (!all) return [];
  const size = all.after_norm_mm;
  return [...all.row.keys()].sort((a, b) => (size[b] ?? -1) - (size[a] ?? -1));
});

/** Index of the picked pose, or the worst one. */
export const picked = computed<number>(() => {
  const all = poses.value;
  if (!all) return -1;
  const at = all.row.indexOf(Number(param("row")));
  return at >= 0 ? at : worstFirst.value[0] ?? -1;
});

export const pickedPose = computed<string | null>(() => poses.value?.pose[picked.value] ?? null);

export function pick(index: number): void {
  const row = poses.value?.row[index];
  if (row !== undefined) setParams({ row });
}

export function pickByName(pose: string): void {
  const all = poses.value;
  if (!all || all.pose[picked.value] === pose) return;
  pick(all.pose.indexOf(pose));
}

/** Rows between two values of one joint, or null if nothing is brushed: address brush=2:-30:15. */
export const brush = computed<{ joint: number; from: number; to: number } | null>(() => {
  const [joint, from, to] = (param("brush") ?? "").split(":").map(Number);
  return param("brush") !== undefined && [joint, from, to].every(Number.isFinite) ? { joint, from, to } : null;
});

export const brushed = computed<Set<number> | null>(() => {
  const all = poses.value, band = brush.value;
  if (!all || !band || !all.q[band.joint]) return null;
  const inside = new Set<number>();
  all.q[band.joint].forEach((q, i) => {
    if (q !== null && q >= band.from && q <= band.to) inside.add(i);
  });
  return inside;
});

/** Moves the picked pose along the list of the worst ones, inside what is brushed. */
export function step(by: number): void {
  const inside = brushed.value;
  const order = worstFirst.value.filter((i) => inside === null || inside.has(i));
  if (order.length === 0) return;
  const at = order.indexOf(picked.value);
  pick(order[Math.max(0, Math.min(order.length - 1, at < 0 ? 0 : at + by))]);
}

let asking = 0;

export async function loadCell(): Promise<void> {
  const mine = ++asking;
  try {
    const answer = await getJson<Cell>("/api/cell");
    if (mine !== asking) return;
    cell.value = answer;
    cellProblem.value = answer.problem;
    if (connection.value !== "other") connection.value = "there";
  } catch (error) {
    if (mine === asking) cellProblem.value = problemOf(error);
  }
}

function loadRun(): void {
  let loading: AbortController | null = null;
  effect(() => {
    const run = runNumber.value;
    state.value; // a run may have been written again
    loading?.abort();
    if (run === null) {
      runDetail.value = null;
      poses.value = null;
      return;
    }
    const mine = (loading = new AbortController());
    Promise.all([
      getJson<RunDetail>(`/api/runs/${run}`, mine.signal),
      getJson<Poses>(`/api/runs/${run}/poses`, mine.signal),
    ]).then(([detail, all]) => {
      runDetail.value = detail;
      poses.value = all;
      runProblem.value = null;
    }).catch((error: unknown) => {
      if (mine.signal.aborted) return;
      runDetail.value = null;
      poses.value = null;
      runProblem.value = problemOf(error);
    });
  });
}

export function start(): void {
  loadRun();
  void loadCell();
  listen(
    (news) => {
      if (news.type === "state" && news.state !== cell.value?.state) void loadCell();
      if (news.type === "job") told(news as unknown as Job);
    },
    () => {
      void loadCell();
      recall({ diagnose: "diagnose", check: "check", compile: "compile", inspect: "inspect", bench: "bench", deploy: "deploy", plan: "plan" })
        .catch(() => undefined);
    },
  );
}
