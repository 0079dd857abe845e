// SPDX-License-Identifier: Apache-2.0
import { useState } from "preact/hooks";
import { resultOf, task } from "../jobs";
import { plain } from "../numbers";
import { Action } from "../parts/action";
import { Blocks } from "../parts/blocks";
import { Card, Scroll } from "../parts/card";
import type { Blocks as All } from "../types";

interface Plan {
  n: number;
  poses: Record<string, string | number>[];
  blocks: All;
}

const kFile = "plan.csv";

export function PlanCard() {
  const [n, setN] = useState(20);
  const plan = resultOf<Plan>("plan");
  const columns = Object.keys(plan?.poses[0] ?? {}).filter((name) => name !== "note");
  return (
    <Card title="What to measure next" lead="The poses that tell most about the numbers of this model.">
      <label>Poses <input type="number" min={1} max={1000} value={n} onChange={(event) => setN(event.currentTarget.valueAsNumber || 20)} /></label>
      <Action purpose="plan" verb="plan" args={["--n", String(n), "-o", kFile, "--force"]}>Plan {n} poses</Action>
      {plan && !task("plan").value.busy && (
        <>
          <Blocks of={plan.blocks} />
          <p><a href={`/api/files/${kFile}`} download={kFile}>Save {kFile}</a></p>
          <Scroll label="Planned poses">
            <table>
              <thead><tr>{columns.map((name) => <th scope="col">{name.replace("_", " [")}{name.includes("_") ? "]" : ""}</th>)}</tr></thead>
              <tbody>{plan.poses.map((pose) => <tr>{columns.map((name) => <td class={typeof pose[name] === "number" ? "n" : ""}>{typeof pose[name] === "number" ? plain(pose[name]) : pose[name]}</td>)}</tr>)}</tbody>
            </table>
          </Scroll>
        </>
      )}
    </Card>
  );
}
