// SPDX-License-Identifier: Apache-2.0
import type { ComponentChildren } from "preact";
import { goTo, type Screen } from "../hash";
import { kScreenNames } from "../hash";
import { Action } from "./action";
import { cell, runNumber, runProblem } from "../store";
import { ProblemBox } from "./problem";

/** What to do where there is nothing to see yet. */
export function Empty({ children, to }: { children: ComponentChildren; to?: Screen }) {
  return (
    <div class="empty">
      <p>{children}</p>
      {to && <button type="button" onClick={() => goTo(to)}>Go to {kScreenNames[to]}</button>}
    </div>
  );
}

/** Stands in for a screen that needs a run, if there is none; else the screen. */
export function NeedsRun({ children }: { children: ComponentChildren }) {
  if (!cell.value) return null;
  if (runProblem.value && runNumber.value !== null) return <ProblemBox problem={runProblem.value} />;
  if (runNumber.value !== null) return <>{children}</>;
  if (!cell.value.data)
    return <Empty to="data">There are no measurements yet. Put a file of measurements into the cell, then fit.</Empty>;
  return (
    <>
      <Empty>There is no run yet. Fit the arm to the measurements; poses that no fit sees then tell its accuracy.</Empty>
      <Action purpose="fit" verb="fit" main>Fit the arm</Action>
    </>
  );
}
