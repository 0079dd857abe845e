// SPDX-License-Identifier: Apache-2.0
import { useEffect, useState } from "preact/hooks";
import { getJson } from "../api";
import { param, setParams } from "../hash";
import { Card } from "../parts/card";
import { Command } from "../parts/command";
import { NeedsRun } from "../parts/empty";
import { Figure } from "../parts/figure";
import { joints, poses, runNumber } from "../store";
import type { FigureRow } from "../types";
import { verdict } from "../verdict";
import { JointPlots } from "./joint_plots";
import { ArmView } from "./view3d";
import { PickedPose, WorstPoses } from "./worst";

const kNeverHere = new Set(["evidence", "waterfall"]); // they have their own screens

export function useFigures(run: number | null): FigureRow[] {
  const [list, setList] = useState<FigureRow[]>([]);
  useEffect(() => {
    if (run === null) return;
    const loading = new AbortController();
    getJson<{ figures: FigureRow[] }>(`/api/figures?run=${run}`, loading.signal)
      .then(({ figures }) => setList(figures)).catch(() => undefined);
    return () => loading.abort();
  }, [run]);
  return list;
}

/** joint-JN stands for one figure a joint. */
export function namesOf(list: FigureRow[]): FigureRow[] {
  return list.flatMap((row) => row.name.includes("JN")
    ? joints.value.map(({ name }) => ({ ...row, name: row.name.replace("JN", name), shows: `${row.shows}: ${name}` })) : [row]);
}

function Figures() {
  const run = runNumber.value;
  const list = namesOf(useFigures(run)).filter(({ name }) => !kNeverHere.has(name));
  const name = list.some((row) => row.name === param("figure")) ? param("figure") ?? "" : list[0]?.name;
  if (!name) return null;
  return (
    <Card title="Figures" class="wide">
      <div class="tools">
        <label>Figure
          <select value={name} onChange={(event) => setParams({ figure: event.currentTarget.value })}>
            {list.map((row) => <option value={row.name}>{row.name}</option>)}
          </select>
        </label>
        <span class="muted">{list.find((row) => row.name === name)?.shows}</span>
      </div>
      <Figure name={name} />
      <Command words={["plot", name, "--run", String(run)]} />
    </Card>
  );
}

export function SeeScreen() {
  const all = poses.value;
  return (
    <NeedsRun>
      {!all ? <p role="status">Computing the errors of every pose …</p> : (
        <div class="see">
          <p class="sentence">{verdict.value.sentence}</p>
          <Card title="Where it fails" class="wide" lead={<span id="worst-region">{all.worst_region.sentence}</span>}>
            <ArmView />
            <PickedPose all={all} />
          </Card>
          <Card title="Worst poses" lead="j and k walk through them; a picked pose is picked everywhere."><WorstPoses /></Card>
          <Card title="Joints"><JointPlots /></Card>
          <Figures />
          <Command words={["compare", String(runNumber.value)]} />
        </div>
      )}
    </NeedsRun>
  );
}
