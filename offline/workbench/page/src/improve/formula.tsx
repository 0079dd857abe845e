// SPDX-License-Identifier: Apache-2.0
// A law of one's own: tried with --dry-run, the error under the character where it is.
import { useState } from "preact/hooks";
import { resultOf, run, task } from "../jobs";
import { mm } from "../numbers";
import { Action, Progress } from "../parts/action";
import { Card } from "../parts/card";
import { Command } from "../parts/command";
import { Drawn, Figure } from "../parts/figure";
import { joints } from "../store";
import type { Problem, Statistics } from "../types";
import { remember } from "./undo";

const kDomains = ["robot", "environment", "procedure", "measurement"];

export function formulaArguments(law: string, parameters: string, name: string, domain: string): string[] {
  const out = ["formula", "--formula", law.trim()];
  for (const line of parameters.split("\n")) if (line.trim() !== "") out.push("--parameter", line.trim());
  if (name.trim() !== "") out.push("--name", name.trim());
  if (domain !== "robot") out.push("--domain", domain);
  return out;
}

/** Where in the law an error is: the place of the program counts characters of the option from 1. */
function caretAt({ place }: Problem, law: string): number | null {
  const column = place?.column ?? 0;
  return place?.file.startsWith("--formula") && column >= 1 && column <= law.length + 1 ? column - 1 : null;
}

function Underlined({ problem, law }: { problem: Problem; law: string }) {
  const at = caretAt(problem, law);
  if (at === null) return null;
  return <pre class="caret" aria-label={`The error is at character ${at + 1}`}>{`${law}\n${" ".repeat(at)}^ here`}</pre>;
}

interface Tried { before: Statistics; after: Statistics; verdict: string; figure?: string }

export function FormulaEditor() {
  const [law, setLaw] = useState("");
  const [parameters, setParameters] = useState("k [rad/(N m)] ~ 1e-6");
  const [name, setName] = useState("");
  const [domain, setDomain] = useState("robot");
  const args = formulaArguments(law, parameters, name, domain);
  const { problem, args: tried, busy } = task("formula").value;
  const result = resultOf<Tried>("formula");
  const same = tried.filter((word) => word !== "--dry-run").join("\0") === args.join("\0");
  const good = same && !busy && !problem && result?.after !== undefined;
  const joint = /^\s*dq(\d+)/.exec(law)?.[1];
  const jointName = joint ? joints.value[Number(joint) - 1]?.name : undefined;
  const onSubmit = (event: Event): void => {
    event.preventDefault();
    void run("formula", "add", [...args, "--dry-run"]);
  };
  return (
    <Card title="A formula of your own" lead="What moves = law. It is fitted with the geometry and judged on held-out poses before anything is written.">
      <form onSubmit={onSubmit} class="form">
        <label>Law <input type="text" id="law" class="code" value={law} placeholder="dq2 = k*tau2" spellcheck={false} autocomplete="off"
          aria-invalid={same && problem ? true : undefined} aria-describedby="law-help" onInput={(event) => setLaw(event.currentTarget.value)} /></label>
        <p id="law-help" class="muted">Targets: dq1 …, tcp.x …, pre2.rx, post2.dz, base.dx, tool.rz. Variables: q1 …, tau1 …, dir1 …, temp, payload, t, x y z.</p>
        <label>Parameters, one a line: name [unit] ~ typical size
          <textarea class="code" rows={2} value={parameters} spellcheck={false} onInput={(event) => setParameters(event.currentTarget.value)} /></label>
        <div class="tools">
          <label>Name <input type="text" value={name} onInput={(event) => setName(event.currentTarget.value)} /></label>
          <label>Belongs to <select value={domain} onChange={(event) => setDomain(event.currentTarget.value)}>{kDomains.map((d) => <option>{d}</option>)}</select></label>
          <button disabled={busy || law.trim() === ""}>Try it</button>
        </div>
        <Command words={["add", ...args, "--dry-run"]} />
      </form>
      {same && problem && <Underlined problem={problem} law={law.trim()} />}
      {(same || busy) && <Progress purpose="formula" />}
      {good && result && (
        <>
          <p role="status">On unseen poses: {mm(result.before.mean_mm)} → <strong>{mm(result.after.mean_mm)} mm</strong>. {result.verdict}</p>
          <Action purpose="add" verb="add" args={args} main id="add-first" shortcut="a" quiet onDone={() => remember(args)}>Add this formula</Action>
          {result.figure && <Drawn name="formula-tried" text={result.figure} />}
        </>
      )}
      {jointName && !(good && result?.figure) && <><p class="muted">What such a law has to explain: the deviation of {jointName} that the model leaves.</p><Figure name={`joint-${jointName}`} /></>}
    </Card>
  );
}
