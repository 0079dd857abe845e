// SPDX-License-Identifier: Apache-2.0
import { useState } from "preact/hooks";
import { addArguments } from "../effects";
import { remember } from "../improve/undo";
import { kNone, mm, plain } from "../numbers";
import { Action } from "../parts/action";
import { Scroll } from "../parts/card";
import { Command } from "../parts/command";
import { Figure } from "../parts/figure";
import type { Candidate } from "../types";
import { planName, titleOf, type Group } from "./groups";

function Numbers({ of }: { of: Candidate }) {
  if (of.parameters.length === 0) return null;
  return (
    <details>
      <summary>Its {of.parameters.length === 1 ? "number" : `${of.parameters.length} numbers`}, with 95 % intervals</summary>
      <Scroll label={`Numbers of ${of.title}`}>
        <table>
          <thead><tr><th scope="col">Name</th><th scope="col">Value</th><th scope="col">±</th><th scope="col">Typical</th><th scope="col">Unit</th></tr></thead>
          <tbody>{of.parameters.map((p) => (
            <tr><th scope="row">{p.name}</th><td class="n">{plain(p.value)}</td><td class="n">{plain(p.ci95)}</td><td class="n">{plain(p.typical)}</td><td>{p.unit}{!p.plausible && " (unusually large)"}</td></tr>
          ))}</tbody>
        </table>
      </Scroll>
    </details>
  );
}

/** Fall of the held-out error as a bar: what is left of what was there. */
function Fall({ before, after }: { before: number | null; after: number | null }) {
  if (before === null || after === null || before <= 0) return null;
  const left = Math.min(1, Math.max(0, after / before));
  return (
    <div class="fall" role="img" aria-label={`Held-out error ${mm(before)} mm before, ${mm(after)} mm with it`}>
      <div class="left" style={{ width: `${100 * left}%` }} />
    </div>
  );
}

function Folded({ summary, others, of, separate }: { summary: string; others: Candidate[]; of?: Candidate; separate?: string }) {
  if (others.length === 0) return null;
  return (
    <details>
      <summary>{summary}</summary>
      <ul>{others.map((other) => <li><strong>{titleOf(other)}</strong>: alone {mm(other.held_out_alone_mm)} mm <AddButton of={other} /></li>)}</ul>
      {separate && <p>What would separate them: {separate}</p>}
      {of && <div>Poses that separate the first two: <Command words={["plan", "--separate", `${planName(of)},${planName(others[0])}`]} /></div>}
    </details>
  );
}

/** What the figure of a candidate shows. */
const kFigureWords: Record<string, string> = {
  order: "in the order of measuring",
  "context-temperature": "over the temperature",
  "context-payload": "over the payload",
  "error-map": "over the workspace",
};
const figureWords = (name: string) => `what is left ${kFigureWords[name] ?? `as a deviation of ${name.replace("joint-", "")}`}`;

export function AddButton({ of, first }: { of: Candidate; first?: boolean }) {
  const args = addArguments(of);
  return (
    <Action purpose="add" verb="add" args={args} main={first} quiet id={first ? "add-first" : undefined}
      shortcut={first ? "a" : undefined} label={`Add ${titleOf(of)}`} onDone={() => remember(args)}>Add</Action>
  );
}

export function CandidateCard({ group, rank, before, addFirst }: { group: Group; rank: number; before: number | null; addFirst: boolean }) {
  const { first, others, variants } = group;
  const [open, setOpen] = useState(rank === 1);
  const more = first.confounded.length > 0 && others.length === 0;
  return (
    <section class={`card candidate ${first.supported ? "" : "unsupported"}`}>
      <h3>{rank}. {titleOf(first)}</h3>
      <Fall before={before} after={first.held_out_alone_mm} />
      <dl class="facts">
        <div><dt>Held-out error with it</dt><dd>{mm(before)} → <strong>{mm(first.held_out_alone_mm)}</strong> mm</dd></div>
        <div><dt>Supported</dt><dd title={`natural logarithm of its Bayes factor: ${plain(first.ln_bayes)}`}>{first.support}</dd></div>
        <div><dt>Explains</dt><dd>{first.share_pct === null ? kNone : `${first.share_pct.toFixed(0)} % of what is left`}</dd></div>
        <div><dt>Largest motion</dt><dd>{mm(first.largest_mm)} mm</dd></div>
      </dl>
      {!first.plausible && <p class="note">Its numbers are larger than usual for such arms: doubt it.</p>}
      {!first.supported && <p class="note">The evidence is not enough to add it.</p>}
      <AddButton of={first} first={addFirst} />
      <Folded others={others} of={first} separate={first.separate_by}
        summary={`${others.length === 1 ? "One other candidate looks" : `${others.length} other candidates look`} similar in these poses`} />
      <Folded others={variants} summary={`The same effect in ${variants.length === 1 ? "another form" : `${variants.length} other forms`}`} />
      {more && <p class="muted">Hard to tell from {first.confounded.join(", ")}.{first.separate_by && ` What would separate them: ${first.separate_by}`}</p>}
      <details open={open} onToggle={(event) => setOpen(event.currentTarget.open)}>
        <summary>The curve: {figureWords(first.figure)}</summary>
        {open && <Figure name={first.figure} />}
      </details>
      <Numbers of={first} />
    </section>
  );
}
