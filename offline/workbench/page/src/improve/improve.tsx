// SPDX-License-Identifier: Apache-2.0
import { task } from "../jobs";
import { Formulas } from "../learn/formulas";
import { LastChange } from "../learn/learn";
import { Action } from "../parts/action";
import { Card } from "../parts/card";
import { Command } from "../parts/command";
import { NeedsRun } from "../parts/empty";
import { Figure } from "../parts/figure";
import { cell, runNumber } from "../store";
import { Board, Worse } from "./board";
import { FormulaEditor } from "./formula";
import { PlanCard } from "./plan";
import { droppable, undoLast, undoWords } from "./undo";

function Model() {
  const words = undoWords.value;
  const present = runNumber.value === cell.value?.current_run;
  return (
    <Card title="The model">
      {words ? (
        <div class="action">
          <button type="button" id="undo" aria-keyshortcuts="u" disabled={task("drop").value.busy} onClick={undoLast}>Undo: drop {words[0]}</button>
          <Command words={["drop", ...words]} />
        </div>
      ) : present && <p>It contains geometry alone. Learn says what to add.</p>}
      {!present && <p class="note">This is not the run of the present cell: undo and add change the present one.</p>}
      <LastChange />
      {present && droppable.value.length > 1 && (
        <details>
          <summary>Drop another of its {droppable.value.length} effects</summary>
          {droppable.value.map((args) => <Action purpose="drop" verb="drop" args={args} quiet>Drop {args.filter((w) => !w.startsWith("--")).join(" of ")}</Action>)}
        </details>
      )}
    </Card>
  );
}

export function ImproveScreen() {
  return (
    <NeedsRun>
      <Card title="How the error fell" class="wide">
        <Figure name="waterfall" />
        <Command words={["plot", "waterfall", "--run", String(runNumber.value)]} />
      </Card>
      <Model />
      <Worse />
      <Board />
      <FormulaEditor />
      <Formulas />
      <PlanCard />
    </NeedsRun>
  );
}
