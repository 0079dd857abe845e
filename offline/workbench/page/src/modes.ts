// SPDX-License-Identifier: Apache-2.0
// Modes of plumb-rt: how much of the correction it sends. docs/safety.md says in which order they are used.
export type Mode = "shadow" | "limited" | "full";

export const kModes: Record<Mode, string> = {
  shadow: "shadow: computes and reports, sends no correction",
  limited: "limited: sends a part of the correction, capped",
  full: "full: sends the whole correction",
};

export const modeWords = (mode: string | undefined): string => kModes[mode as Mode] ?? mode ?? "";
