// SPDX-License-Identifier: Apache-2.0
// What the server sends. docs/workbench.md describes it; the results of verbs are those of --json.

import type { Blocks, Diagnosis, Statistics } from "./results";

export type { Blocks, Diagnosis, Statistics };
export type Candidate = Diagnosis["candidates"][number];

export interface Place { file: string; line: number; column: number }

export interface Problem {
  severity?: "error" | "warning" | "note";
  code: string;
  message: string;
  place?: Place | null;
  file?: string | null;
  line?: number | null;
  help?: string;
  problems?: Problem[];
}

export interface Joint { name: string; type: "revolute" | "prismatic"; unit: "deg" | "mm"; lower: number | null; upper: number | null }

export interface RunRow {
  run: number;
  created: string;
  effects?: string[];
  base?: string;
  current: boolean;
  held_out?: Statistics | null;
  verdict_error?: Statistics | null;   // the same without single readings that stand out
  fit?: Statistics | null;
  damaged?: Problem;   // instead of the rest, if it cannot be read
}

export interface Cell {
  cell: {
    name: string; serial: string; robot: string; folder: string;
    tolerance_mm: number | null; joints: Joint[]; contexts: string[];
  } | null;
  toml: string;
  state: number;
  data: { files: { name: string; rows: number }[]; rows: number; poses: number; used: number } | null;
  runs: RunRow[];
  current_run: number | null;
  command: string;
  problem: Problem | null;
}

export interface Parameter {
  name: string; unit: string;
  value: number | null; std: number | null; nominal: number | null; change: number | null;
}

export type VerdictClass = "good" | "partly" | "bad" | "unknown";

export interface RunDetail {
  parameters: Parameter[];
  held_out: Statistics | null;
  verdict_error: Statistics | null;
  fit: Statistics | null;
  nominal?: Statistics | null;
  noise_floor_mm: number | null;
  tolerance_mm?: number | null;
  verdict?: string;
  verdict_head?: string;
  verdict_class?: VerdictClass;
  effects: { effect: string; joints: string[]; name?: string }[];
}

export type PoseSet = "fit" | "held" | "out";
export type Columns3 = [(number | null)[], (number | null)[], (number | null)[]];

export interface Poses {
  run: number;
  row: number[];   // from 0
  pose: string[];
  set: PoseSet[];
  q: (number | null)[][];
  q_units: string[];
  point_mm: Columns3;
  before_mm: Columns3;
  after_mm: Columns3;
  before_norm_mm: (number | null)[];
  after_norm_mm: (number | null)[];
  worst_region: { sentence: string; rows: number[] };
  reach_mm: number | null;
  verdict: string;
  verdict_head: string;
  verdict_class: VerdictClass;
}

export interface Frames { row: number; origins_mm: number[][]; axes: number[][][] }

export type JobState = "waiting" | "running" | "done" | "failed" | "stopped";

export interface Envelope {
  ok: boolean;
  warnings?: Problem[];
  result: Record<string, unknown> | null;
  error: Problem | null;
}

export interface Job {
  job: number;
  verb: string;
  args?: string[];
  command: string;
  state: JobState;
  progress: string[];
  exit: number | null;
  output?: Envelope | null;
  seconds: number | null;
}

export interface CellFile { name: string; bytes: number; changed: string }
export interface FigureRow { name: string; title?: string; shows: string }
