// SPDX-License-Identifier: Apache-2.0
import type { Candidate } from "../types";

/** A cause, what cannot be told from it, and the same effect at other joints or with other options. */
export interface Group { first: Candidate; others: Candidate[]; variants: Candidate[] }

/** "reversal:J2,J3", the beginning of the name under which others mention the candidate. */
export const nameOf = ({ effect, joints }: Candidate): string =>
  joints.length > 0 ? `${effect}:${joints.join(",")}` : effect;

/** As plumb plan --separate takes it: "gear_ripple:J2@cycles_per_turn=20". */
export function planName({ effect, joints, options, cycles_per_turn }: Candidate): string {
  const numbers = Object.entries(options).filter(([key, value]) => typeof value === "number" && key !== "cycles_per_turn");
  const cycles = cycles_per_turn.length > 0 ? [["cycles_per_turn", cycles_per_turn[0]]] : [];
  return effect + (joints.length > 0 ? `:${joints.join("+")}` : "") + [...numbers, ...cycles].map(([key, value]) => `@${key}=${value}`).join("");
}

/** "cross compliance of J3, J2" */
export const titleOf = ({ title, joints }: Candidate): string =>
  joints.length > 0 && !joints.some((joint) => title.includes(joint)) ? `${title} of ${joints.join(", ")}` : title;

/** Each candidate that cannot be told from a better one is folded into the row of that one. */
export function grouped(candidates: Candidate[]): Group[] {
  const out: Group[] = [];
  for (const candidate of candidates) {
    const name = nameOf(candidate);
    const home = out.find(({ first }) =>
      first.confounded.some((other) => other === name || other.startsWith(`${name}@`)) ||
      candidate.confounded.some((other) => other === nameOf(first) || other.startsWith(`${nameOf(first)}@`)));
    const twin = out.find(({ first }) => first.effect === candidate.effect);
    if (home) home.others.push(candidate);
    else if (twin) twin.variants.push(candidate);
    else out.push({ first: candidate, others: [], variants: [] });
  }
  return out;
}

/** Whether adding it is advised: the poses support it, alone or as one of several, and unseen ones agree. */
export const helps = ({ support }: Candidate): boolean => support === "yes" || support.startsWith("one of");
