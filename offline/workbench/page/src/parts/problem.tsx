// SPDX-License-Identifier: Apache-2.0
import type { ComponentChildren } from "preact";
import type { Problem } from "../types";

const kWords = { error: "Error", warning: "Warning", note: "Note" } as const;

export function placeText({ place, file, line }: Problem): string {
  const where = place?.file ?? file ?? "";
  const row = place?.line ?? line ?? 0;
  return where === "" ? "" : row > 0 ? `${where}, line ${row}` : where;
}

/** A problem as the programs word it: what, where, and what helps. */
export function ProblemBox({ problem, children }: { problem: Problem; children?: ComponentChildren }) {
  const severity = problem.severity ?? "error";
  const where = placeText(problem);
  return (
    <div class={`problem ${severity}`} role={severity === "error" ? "alert" : undefined}>
      <p><strong>{kWords[severity]}{problem.code ? ` ${problem.code}` : ""}:</strong> {problem.message}</p>
      {where && <p class="muted">{where}</p>}
      {problem.help && <p>What helps: <code>{problem.help}</code></p>}
      {children}
    </div>
  );
}
