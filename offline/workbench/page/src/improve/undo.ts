// SPDX-License-Identifier: Apache-2.0
import { computed, signal } from "@preact/signals";
import { run, task } from "../jobs";
import { undoArguments } from "../effects";
import { cell, runDetail, runNumber } from "../store";

/** Arguments of the additions of this tab that were not taken back, the last one last. */
const additions = signal<string[][]>([]);

export const remember = (args: string[]): void => { additions.value = [...additions.value, args]; };

/** Arguments of plumb drop for each effect of the run, as they are listed. */
export const droppable = computed<string[][]>(() =>
  (runDetail.value?.effects ?? [])
    .filter(({ effect }) => effect !== "geometry")
    .map(({ effect, joints, name }) =>
      effect === "formula" ? ["formula", ...(name ? ["--name", name] : [])]
        : joints.length > 0 ? [effect, "--joints", joints.join(",")] : [effect]));

/** What undo would drop: what was added last here, else the last effect of the run. */
export const undoWords = computed<string[] | null>(() => {
  if (runNumber.value !== cell.value?.current_run) return null; // an earlier run: nothing of the present cell
  const last = additions.value[additions.value.length - 1];
  if (last) return undoArguments(last);
  return droppable.value[droppable.value.length - 1] ?? null;
});

export const forgetLast = (): void => { additions.value = additions.value.slice(0, -1); };

export function undoLast(): void {
  const words = undoWords.value;
  if (!words || task("drop").value.busy || task("add").value.busy) return;
  void run("drop", "drop", words).then((output) => { if (output?.ok) forgetLast(); });
}
