// SPDX-License-Identifier: Apache-2.0
// Made from docs/schemas by tests/pages/page_types.py; do not edit.

export type Statistics = {
  n: number;
  mean_mm: number | null;
  rms_mm: number | null;
  p95_mm: number | null;
  max_mm: number | null;
};

export type Finding = {
  class: "good" | "good_but" | "limited" | "missing" | "undecidable" | "not_good";
  sentence: string;
  where: string;
  why: { text: string; state: "certain" | "a_or_b" | "doubtful" | "nothing" | "not_looked" };
  next: string;
  next_why: string;
};

export type NoiseFloor = { measured_mm: number | null; inferred_mm: number | null; source: "repeats" | "sigma" | "none" };

export type Blocks = {
  kind: "sentence" | "note" | "table" | "figure" | "action";
  words?: string;
  class?: "good" | "partly" | "bad" | "unknown" | "";
  name?: string;
  caption?: string;
  head?: string[];
  rows?: string[][];
  command?: string;
  why?: string;
}[];

export interface Diagnosis {
  verdict: "complete" | "missing" | "unknown" | "undecidable";
  verdict_text: string;
  finding: Finding | null;
  blocks: Blocks;
  noise_floor: NoiseFloor;
  noise_floor_mm: number | null;
  noise_floor_rms_mm: number | null;
  noise_floor_source?: "repeats" | "sigma";
  inferred_floor_mm?: number;
  repeatability?: { joint: string; unit: "rad" | "m"; std: number | null }[];
  poses_fit: number;
  poses_held_out: number;
  poses_choosing: number;
  folds: number;
  nested: boolean;
  held_out_before_mm: number | null;
  held_out_before_rms_mm: number | null;
  held_out_after_mm: number | null;
  held_out_after_rms_mm: number | null;
  held_out_before: Statistics;
  held_out_after: Statistics;
  held_out_orientation?: { before_deg: number | null; after_deg: number | null; noise_floor_deg: number | null };
  added: {
    effect: string;
    joints: string[];
    options: Record<string, unknown>;
    cycles_per_turn: number[];
    ln_bayes: number | null;
    held_out_mm: number | null;
    held_out_rms_mm: number | null;
    moves?: { after_row: number; size_mm: number | null }[];
    alternatives: {
      effect: string;
      joints: string[];
      options: Record<string, unknown>;
      cycles_per_turn: number[];
      domain: string;
      behind_nats: number | null;
      not_shown?: string;
      measure?: string;
    }[];
  }[];
  candidates: {
    effect: string;
    joints: string[];
    title: string;
    figure: string;
    ln_bayes: number | null;
    held_out_alone_mm: number | null;
    held_out_alone_rms_mm: number | null;
    held_out_after_mm: number | null;
    held_out_after_rms_mm: number | null;
    gain_pct: number | null;
    gain_se_pct: number | null;
    cycles_per_turn: number[];
    domain: string;
    supported: boolean;
    plausible: boolean;
    support: string;
    options: Record<string, unknown>;
    parameters: {
      name: string;
      unit: string;
      value: number | null;
      std: number | null;
      ci95: number | null;
      typical: number | null;
      plausible: boolean;
    }[];
    share_pct: number | null;
    absorbed_by_geometry_pct: number | null;
    largest_mm: number | null;
    confounded_with: string[];
    confounded: string[];
    moves?: { after_row: number; size_mm: number | null }[];
    separate_by?: string;
  }[];
  alternatives: {
    effect: string;
    joints: string[];
    options: Record<string, unknown>;
    cycles_per_turn: number[];
    domain: string;
    behind_nats: number | null;
    not_shown?: string;
    measure?: string;
  }[];
  not_added?: {
    effect: string;
    joints: string[];
    options: Record<string, unknown>;
    cycles_per_turn: number[];
    domain: string;
    alternatives: {
      effect: string;
      joints: string[];
      options: Record<string, unknown>;
      cycles_per_turn: number[];
      domain: string;
      behind_nats: number | null;
      not_shown?: string;
      measure?: string;
    }[];
    slow_motion?: {
      subject: string;
      words: string;
      depends_on: string[];
      harmonic: number | null;
      share_pct: number | null;
      rms_mm: number | null;
      rms_urad: number | null;
    };
  };
  slow_motion?: {
    subject: string;
    words: string;
    depends_on: string[];
    harmonic: number | null;
    share_pct: number | null;
    rms_mm: number | null;
    rms_urad: number | null;
  };
  gravity?: { stated: number[]; found: number[]; certain: boolean; nats_ahead: number | null };
  not_testable: { effect: string; why: string; measure: string }[];
  unknown: {
    subject: string;
    words: string;
    depends_on: string[];
    harmonic: number | null;
    share_pct: number | null;
    rms_mm: number | null;
    rms_urad: number | null;
    alternatives?: {
      effect: string;
      joints: string[];
      options: Record<string, unknown>;
      cycles_per_turn: number[];
      domain: string;
      behind_nats: number | null;
      not_shown?: string;
      measure?: string;
    }[];
  } | null;
  formulas: {
    formula: string;
    domain: string;
    options: Record<string, unknown>;
    parameters: { name: string; unit: string; value: number | null; std: number | null }[];
    command: string;
    held_out_before_mm: number | null;
    held_out_before_rms_mm: number | null;
    held_out_after_mm: number | null;
    held_out_after_rms_mm: number | null;
    fall_mm: number | null;
    fall_se_mm: number | null;
    nats: number | null;
    curve: { input: string; input_unit: string; unit: "rad" | "m"; points: number[][] };
  }[];
  verdict_after?: "complete" | "missing" | "unknown" | "undecidable";
  verdict_after_text?: string;
  unlikely: { effect: string; joints: string[]; options: Record<string, unknown>; times_usual: number | null }[];
  left_over: { times_floor: number; unavoidable_times: number; lack_of_fit: boolean } | null;
  outliers: string[];
  blocks_tried: number;
  run?: number | null;
  files?: string[];
  dry_run?: boolean;
}
