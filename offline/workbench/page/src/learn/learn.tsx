// SPDX-License-Identifier: Apache-2.0
import { useState } from "preact/hooks";
import { resultOf, task } from "../jobs";
import { mm } from "../numbers";
import { Action, Progress } from "../parts/action";
import { Card, Scroll } from "../parts/card";
import { Empty, NeedsRun } from "../parts/empty";
import { Figure } from "../parts/figure";
import type { Diagnosis, Statistics } from "../types";
import { CandidateCard } from "./candidate";
import { Formulas } from "./formulas";
import { grouped } from "./groups";

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

function NotTestable({ rows }: { rows: Diagnosis["not_testable"] }) {
  if (rows.length === 0) return null;
  return (
    <Card title="Not testable with these data" class="wide" lead="What could not be tried, and what to measure so that it can.">
      <Scroll label="Effects that are not testable">
        <table>
          <thead><tr><th scope="col">Effect</th><th scope="col">Why</th><th scope="col">Measure</th></tr></thead>
          <tbody>{rows.map(({ effect, why, measure }) => <tr><th scope="row">{effect}</th><td class="text">{why}</td><td class="text">{measure}</td></tr>)}</tbody>
        </table>
      </Scroll>
    </Card>
  );
}

const kFirst = 5; // groups that are shown at once

function Found({ diagnosis }: { diagnosis: Diagnosis }) {
  const [all, setAll] = useState(false);
  const [evidence, setEvidence] = useState(false);
  const groups = grouped(diagnosis.candidates);
  const supported = groups.filter(({ first }) => first.supported).length;
  const shown = all ? groups : groups.slice(0, Math.max(1, Math.min(kFirst, supported + 1)));
  return (
    <>
      <p class="sentence" id="diagnosis">{diagnosis.verdict_text}</p>
      {diagnosis.unknown && <p class="note">{diagnosis.unknown.words}</p>}
      {groups.length > 0 && <h2>Ranked causes</h2>}
      {shown.map((group, i) => (
        <CandidateCard group={group} rank={i + 1} before={diagnosis.held_out_before_mm} addFirst={i === 0} />
      ))}
      {groups.length > shown.length && <button type="button" onClick={() => setAll(true)}>Show all {groups.length} that were tried</button>}
      <NotTestable rows={diagnosis.not_testable} />
      <details onToggle={(event) => { if (event.currentTarget.open) setEvidence(true); }}>
        <summary>Evidence of all candidates as a figure (diagnoses again)</summary>
        {evidence && <Figure name="evidence" />}
      </details>
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
      {diagnosis && !busy ? <Found diagnosis={diagnosis} />
        : !busy && <Empty>Press Learn. It takes a few seconds, some minutes with many poses; you may look at other screens meanwhile.</Empty>}
      <Formulas />
    </NeedsRun>
  );
}
