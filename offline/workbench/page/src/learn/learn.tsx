// SPDX-License-Identifier: Apache-2.0
import { useState } from "preact/hooks";
import { resultOf, task } from "../jobs";
import { mm } from "../numbers";
import { Action, Progress } from "../parts/action";
import { Blocks } from "../parts/blocks";
import { Card } from "../parts/card";
import { Empty, NeedsRun } from "../parts/empty";
import type { Diagnosis, Statistics } from "../types";
import { CandidateCard } from "./candidate";
import { Formulas } from "./formulas";
import { grouped, helps } from "./groups";

interface Added { before: Statistics; after: Statistics; verdict: string }

/** What the last addition or removal did to the held-out error. */
export function LastChange() {
  const [add, drop] = [task("add").value, task("drop").value];
  const dropped = drop.busy || (!add.busy && (drop.job?.job ?? -1) > (add.job?.job ?? -1));
  const purpose = dropped ? "drop" : "add", verb = dropped ? "Dropped" : "Added";
  const { busy } = task(purpose).value, result = resultOf<Added>(purpose);
  if (busy || !result?.after) return <Progress purpose={purpose} />;
  return (
    <div class="change" role="status">
      <p><strong>{verb}: the held-out error went from {mm(result.before.mean_mm)} to {mm(result.after.mean_mm)} mm.</strong></p>
      <p>{result.verdict}</p>
    </div>
  );
}

const kFirst = 5; // groups that are shown at once

function Causes({ diagnosis }: { diagnosis: Diagnosis }) {
  const [all, setAll] = useState(false);
  const groups = grouped(diagnosis.candidates);
  const supported = groups.filter(({ first }) => first.supported).length;
  const shown = all ? groups : groups.slice(0, Math.max(1, Math.min(kFirst, supported + 1)));
  return (
    <>
      {groups.length > 0 && <h2>Ranked causes</h2>}
      {shown.map((group, i) => (
        <CandidateCard group={group} rank={i + 1} before={diagnosis.held_out_before_mm} addFirst={i === 0 && helps(group.first)} />
      ))}
      {groups.length > shown.length && <button type="button" onClick={() => setAll(true)}>Show all {groups.length} that were tried</button>}
    </>
  );
}

export function LearnScreen() {
  const { job, busy } = task("diagnose").value;
  const diagnosis = resultOf<Diagnosis>("diagnose");
  const changed = [task("add"), task("drop")].some(({ value }) =>
    value.job?.state === "done" && job !== null && value.job.job > job.job);
  return (
    <NeedsRun>
      <Card title="Which physical effect is missing?" lead="Every effect of the library is tried on the poses that were fitted and judged on poses that no fit saw.">
        <Action purpose="diagnose" verb="diagnose" main id="learn">{diagnosis ? "Learn again" : "Learn"}</Action>
      </Card>
      <LastChange />
      {changed && !busy && <p class="note">The model has changed since this diagnosis. Learn again to see what is still missing.</p>}
      {diagnosis && !busy ? <Blocks of={diagnosis.blocks} instead={{ ...(diagnosis.added.length === 0 && { steps: null }), candidates: <Causes diagnosis={diagnosis} /> }} />
        : !busy && <Empty>Press Learn. It takes a few seconds, some minutes with many poses; you may look at other screens meanwhile.</Empty>}
      <Formulas />
    </NeedsRun>
  );
}
