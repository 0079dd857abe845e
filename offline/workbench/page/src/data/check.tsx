// SPDX-License-Identifier: Apache-2.0
import { resultOf, task } from "../jobs";
import { Action, Progress } from "../parts/action";
import { Blocks } from "../parts/blocks";
import { Card } from "../parts/card";
import { ProblemBox } from "../parts/problem";
import type { Blocks as All, Problem } from "../types";
import { files, isText, RawPreview } from "./files";

interface Check {
  blocks: All;
  findings: Problem[];
  convention: { changed: boolean } | null;
}

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
  const [verdict, ...rest] = found && !busy ? found.blocks : [];
  return (
    <>
      <Card title="What check says" class="wide" lead="Units, conventions, coverage, and which effects these data can show.">
        <Action purpose="check" verb="check" main quiet>Check</Action>
        <Progress purpose="check" warnings={false} />
        {found && verdict && (
          <>
            <Blocks of={[verdict]} />
            {(found.findings ?? []).map((problem) => <Finding problem={problem} />)}
            {found.convention?.changed && <Action purpose="fix" verb="check" args={["--fix"]}>Put the labels right</Action>}
          </>
        )}
      </Card>
      {rest.length > 0 && <Blocks of={rest} />}
    </>
  );
}
