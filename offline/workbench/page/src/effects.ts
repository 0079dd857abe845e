// SPDX-License-Identifier: Apache-2.0
// Arguments of plumb add and plumb drop.
import type { Candidate } from "./types";

const isWord = (value: unknown): value is string | number | boolean =>
  ["string", "number", "boolean"].includes(typeof value);

export function addArguments(candidate: Candidate): string[] {
  const out = [candidate.effect];
  if (candidate.joints.length > 0) out.push("--joints", candidate.joints.join(","));
  for (const [key, value] of Object.entries(candidate.options)) {
    if (key === "cycles_per_turn" && candidate.cycles_per_turn.length > 0) continue;
    if (isWord(value)) out.push("--set", `${key}=${value}`);
  }
  if (candidate.cycles_per_turn.length > 0) out.push("--set", `cycles_per_turn=${candidate.cycles_per_turn.join(",")}`);
  return out;
}

/** What takes back `plumb add ARGS`. A formula is dropped by its name. */
export function undoArguments(args: string[]): string[] {
  if (args[0] !== "formula") return args.filter((word) => word !== "--dry-run");
  const name = args.indexOf("--name");
  return name >= 0 ? ["formula", "--name", args[name + 1]] : ["formula"];
}
