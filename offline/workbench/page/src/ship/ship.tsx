// SPDX-License-Identifier: Apache-2.0
import { useState } from "preact/hooks";
import { resultOf, task } from "../jobs";
import { kModes, modeWords, type Mode } from "../modes";
import { bytes as size, count, mm, plain, withMm } from "../numbers";
import { Action } from "../parts/action";
import { Card, Scroll } from "../parts/card";
import { NeedsRun } from "../parts/empty";
import { Figure } from "../parts/figure";
import { runDetail } from "../store";
import type { Statistics } from "../types";

const kModel = "robot.plumb", kLatency = "latency.svg", kFolder = "deploy";

interface Audit { worst_correction_mm: number | null; worst_rotation_deg: number | null; max_correction_mm: number | null; worst_leaf_jump_mm: number | null; leaves: number; bytes: number; poses_looked_at: number }
interface Compiled { run: number | null; verdict_error: Statistics; audit: Audit }
interface Inspected { sound: boolean; robot: string; serial: string; effects: { effect: string; version: number; formula?: string }[]; trees: { axis: string; leaves: number }[]; domain: Record<string, string | number>[]; guard: Record<string, unknown> }
interface Bench { ns_median: number | null; ns_p99: number | null; ns_max: number | null; allocations: number; representative: boolean; cycle_us: number; share_of_cycle_pct: number; conditions: { why_not_representative: string[] } }
interface Deployed { folder: string; files: string[]; robot_number: number; model_number: number; mode?: string; max_correction_mm?: number; worst_bus_load_pct: number | null }

const us = (ns: number | null): string => (ns === null ? "–" : `${plain(ns / 1000)} us`);

/** The result of a purpose while it is not running anew. */
function fresh<T>(purpose: string): T | null {
  const { busy, problem } = task(purpose).value;
  return busy || problem ? null : resultOf<T>(purpose);
}

function CompileCard() {
  const made = fresh<Compiled>("compile");
  return (
    <Card title="1. Compile" lead="The model file for the controller, with its audit.">
      <Action purpose="compile" verb="compile" args={["--force"]} main id="compile">Compile</Action>
      {made && (
        <dl class="facts">
          <div><dt>Made of run</dt><dd>{made.run ?? "–"}</dd></div>
          <div><dt>Held-out error</dt><dd>{withMm(made.verdict_error?.mean_mm)}</dd></div>
          <div><dt>Largest correction</dt><dd>{mm(made.audit.worst_correction_mm)} of {mm(made.audit.max_correction_mm)} mm allowed</dd></div>
          <div><dt>Size</dt><dd>{size(made.audit.bytes)}</dd></div>
          <div><dt>Audit looked at</dt><dd>{count(made.audit.poses_looked_at, "random pose")}</dd></div>
        </dl>
      )}
    </Card>
  );
}

function InspectCard() {
  const found = fresh<Inspected>("inspect");
  const leaves = (found?.trees ?? []).reduce((n, tree) => n + tree.leaves, 0);
  const compiled = new Set(found?.effects.map(({ effect }) => effect));
  const fitted = [...new Set((runDetail.value?.effects ?? []).map(({ effect }) => effect))].filter((effect) => effect !== "geometry");
  return (
    <Card title="2. Inspect" lead="What the file holds: what is compiled, and what only cleaned the measurements.">
      <Action purpose="inspect" verb="inspect" args={[kModel]} id="inspect">Inspect</Action>
      {found && (
        <div role="status">
          <p><strong>{found.sound ? "The file is whole and can be used." : "The file cannot be used."}</strong> It is bound to {found.robot || "the arm"}{found.serial ? `, serial ${found.serial}` : ", no serial"}.</p>
          <ul>
            <li>Compiled: calibrated geometry{found.effects.map(({ effect, formula }) => `, ${effect}${formula ? ` (${formula})` : ""}`).join("")}{leaves > 0 ? `, a tree of ${leaves} leaves` : ""}</li>
            {fitted.some((effect) => !compiled.has(effect)) && <li>Only cleaned, not compiled: {fitted.filter((effect) => !compiled.has(effect)).join(", ")}</li>}
          </ul>
        </div>
      )}
    </Card>
  );
}

function BenchCard() {
  const found = fresh<Bench>("bench");
  return (
    <Card title="3. Bench" lead="What a cycle of this model costs.">
      <Action purpose="bench" verb="bench" args={[kModel, "-o", kLatency, "--force"]}>Time it</Action>
      {found && (
        <>
          <dl class="facts">
            <div><dt>Median</dt><dd>{us(found.ns_median)}</dd></div>
            <div><dt>99 %</dt><dd>{us(found.ns_p99)}</dd></div>
            <div><dt>Longest</dt><dd>{us(found.ns_max)}</dd></div>
            <div><dt>Share of the cycle of {found.cycle_us} us</dt><dd>{plain(found.share_of_cycle_pct)} %</dd></div>
            <div><dt>Heap calls</dt><dd>{found.allocations}</dd></div>
          </dl>
          {!found.representative && <p class="note">Not representative: {found.conditions.why_not_representative.join("; ")}.</p>}
          <Figure name="latency" path={`/api/files/${kLatency}?job=${task("bench").value.job?.job ?? 0}`} label="Histogram of the latency" />
        </>
      )}
    </Card>
  );
}

function DeployCard() {
  const made = fresh<Deployed>("deploy");
  const [mode, setMode] = useState<Mode>((made?.mode as Mode | undefined) ?? "shadow");
  return (
    <Card title="4. Deploy" lead="A folder with everything that plumb-rt needs.">
      <label>Mode of plumb-rt{" "}
        <select id="mode" value={mode} onChange={(event) => setMode(event.currentTarget.value as Mode)}>
          {Object.entries(kModes).map(([name, words]) => <option value={name}>{words}</option>)}
        </select>
      </label>
      {mode !== "shadow" && <p class="note">Taught points shift when the correction starts, and it is not a safety function. First watch a shift in shadow, then limited, then full: docs/safety.md.</p>}
      <Action purpose="deploy" verb="deploy" args={["-o", kFolder, "--mode", mode, "--force"]} id="deploy">Write the folder</Action>
      {made && (
        <div role="status">
          <p id="deployed-mode"><strong>Mode {modeWords(made.mode)}.</strong>{made.max_correction_mm !== undefined && ` Never more than ${mm(made.max_correction_mm)} mm, which the model allows.`} To change it, choose another mode and write the folder again, or edit [limits] mode in {made.folder}/rt.toml; plumb-rt reads it when it starts.</p>
          <p>Written: {made.files.join(", ")}.</p>
          <p>Robot number {made.robot_number}, model number {made.model_number} on the bus{made.worst_bus_load_pct === null ? "" : `; worst load of the bus ${plain(made.worst_bus_load_pct)} %`}. Monitor runs it.</p>
        </div>
      )}
    </Card>
  );
}

function BusCard() {
  const dbc = fresh<{ dbc?: string; messages: number; worst_bus_load_pct: number | null }>("dbc");
  const map = fresh<{ markdown?: string; registers: number }>("modbus-map");
  return (
    <Card title="What stands on the bus" class="wide">
      <Action purpose="dbc" verb="dbc">Show the CAN layout (DBC)</Action>
      {dbc?.dbc && <Scroll label="DBC file"><pre>{dbc.dbc}</pre></Scroll>}
      <Action purpose="modbus-map" verb="modbus-map">Show the Modbus registers</Action>
      {map?.markdown && <Scroll label="Modbus registers"><pre>{map.markdown}</pre></Scroll>}
    </Card>
  );
}

export function ShipScreen() {
  return <NeedsRun><CompileCard /><InspectCard /><BenchCard /><DeployCard /><BusCard /></NeedsRun>;
}
