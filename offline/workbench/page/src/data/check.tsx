// SPDX-License-Identifier: Apache-2.0
import { resultOf, task } from "../jobs";
import { kNone, plain, withMm } from "../numbers";
import { Action, Progress } from "../parts/action";
import { Card, Scroll } from "../parts/card";
import { ProblemBox } from "../parts/problem";
import type { Problem } from "../types";
import { files, isText, RawPreview } from "./files";

interface Check {
  verdict: string;
  findings: Problem[];
  convention: { changed: boolean } | null;
  coverage: { joint: string; share: number; text: string }[];
  noise_floor_mm: number | null;
  noise_floor_source?: string;
  effects: { effect: string; testable: "no" | "weakly" | "yes"; why: string; measure: string }[];
  poses?: number;
  readings?: number;
}

const kTestable = { yes: "yes", weakly: "weakly", no: "no" } as const;

function Finding({ problem }: { problem: Problem }) {
  const file = problem.place?.file ?? "", line = problem.place?.line ?? 0;
  const name = file.split("/").pop() ?? "";
  return (
    <ProblemBox problem={problem}>
      {line > 0 && isText(name) && files.value.some((f) => f.name === name) && <RawPreview name={name} line={line} />}
    </ProblemBox>
  );
}

export function CheckCard() {
  const found = resultOf<Check>("check"), { busy } = task("check").value;
  return (
    <Card title="What check says" class="wide" lead="Units, conventions, coverage, and which effects these data can show.">
      <Action purpose="check" verb="check" main quiet>Check</Action>
      <Progress purpose="check" warnings={false} />
      {found && !busy && (
        <>
          <p class="sentence">{found.verdict}</p>
          {(found.findings ?? []).map((problem) => <Finding problem={problem} />)}
          {found.convention?.changed && <Action purpose="fix" verb="check" args={["--fix"]}>Put the labels right</Action>}
          <p>{found.readings ?? 0} readings of {found.poses ?? 0} distinct poses. Noise floor: {withMm(found.noise_floor_mm)}{found.noise_floor_source ? ` (from ${found.noise_floor_source})` : ""}.</p>
          <div class="columns">
            <Scroll label="Coverage of the joints">
              <table>
                <caption>Coverage</caption>
                <thead><tr><th scope="col">Joint</th><th scope="col">Share of its range</th><th scope="col">In words</th></tr></thead>
                <tbody>{(found.coverage ?? []).map(({ joint, share, text }) => (
                  <tr><th scope="row">{joint}</th><td class="n">{Number.isFinite(share) ? `${plain(Math.round(100 * share))} %` : kNone}</td><td class="text">{text}</td></tr>
                ))}</tbody>
              </table>
            </Scroll>
            <Scroll label="Effects that these data can show">
              <table>
                <caption>What these data can show</caption>
                <thead><tr><th scope="col">Effect</th><th scope="col">Testable</th><th scope="col">Why, and what to measure</th></tr></thead>
                <tbody>{(found.effects ?? []).map(({ effect, testable, why, measure }) => (
                  <tr><th scope="row">{effect}</th><td>{kTestable[testable]}</td><td class="text">{why}{measure ? ` ${measure}` : ""}</td></tr>
                ))}</tbody>
              </table>
            </Scroll>
          </div>
        </>
      )}
    </Card>
  );
}
