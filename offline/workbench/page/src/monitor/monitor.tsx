// SPDX-License-Identifier: Apache-2.0
import type { ComponentChildren } from "preact";
import { useEffect, useState } from "preact/hooks";
import { getJson, postJson, problemOf } from "../api";
import { param, setParams } from "../hash";
import { kNone, plain } from "../numbers";
import { Card, Scroll } from "../parts/card";
import { Command } from "../parts/command";
import { Empty } from "../parts/empty";
import { ProblemBox } from "../parts/problem";
import { shellLine } from "../shell";
import type { Problem } from "../types";
import { modeWords } from "../modes";
import { Replay } from "./replay";
import { Series } from "./series";
import { TwinCard, type Stops } from "./twin";

interface Status {
  state: string; mode: string; fault: string; status: string; lost: string[]; has_output: boolean;
  correction: { wanted_um: number; wanted_urad: number; applied_um: number; applied_urad: number };
  ages: Record<string, number | null>;
  counters: Record<string, number>;
  link: Record<string, string | number>;
  clock: Record<string, number>;
  work: { median_us: number; p99_us: number; worst_us: number };
  wake: { median_us: number; p99_us: number; worst_us: number };
  model: Record<string, unknown> | null;
}

interface Monitor {
  running: boolean;
  twin?: boolean;
  folder?: string;
  folders?: string[];
  status: Status | null;
  limits?: { max_correction_mm: number | null; cycle_us: number | null; mode: string; limited_mm: number; limited_scale: number } | null;
  stops?: Stops | null;
  twin_command?: string | null;
  problem?: Problem | null;
}

interface Moment { seconds: number; status: Status }

const kPoll = 500;        // [ms]
const kMoments = 1200;    // ten minutes
const kStateWords: Record<string, string> = {
  init: "starting", sync: "comparing poses with the controller", shadow: "watching, sends nothing", active: "correcting",
  hold: "holding the correction", fault: "fault, no correction",
};

/** Asks again and again while the screen is open. */
function useMonitor(folder: string): { now: Monitor | null; past: Moment[]; problem: Problem | null; ask: () => void } {
  const [now, setNow] = useState<Monitor | null>(null);
  const [past, setPast] = useState<Moment[]>([]);
  const [problem, setProblem] = useState<Problem | null>(null);
  const [again, setAgain] = useState(0);
  useEffect(() => {
    let timer = 0;
    const loading = new AbortController(), begin = performance.now();
    setPast([]);
    const ask = (): void => {
      getJson<Monitor>(`/api/monitor${folder ? `?folder=${encodeURIComponent(folder)}` : ""}`, loading.signal).then((answer) => {
        setNow(answer);
        setProblem(answer.problem ?? null);
        if (answer.running && answer.status) {
          const moment = { seconds: (performance.now() - begin) / 1000, status: answer.status };
          setPast((old) => [...old.slice(-kMoments), moment]);
        }
      }).catch((error: unknown) => { if (!loading.signal.aborted) setProblem(problemOf(error)); })
        .finally(() => { if (!loading.signal.aborted) timer = window.setTimeout(ask, kPoll); });
    };
    ask();
    return () => {
      loading.abort();
      clearTimeout(timer);
    };
  }, [folder, again]);
  return { now, past, problem, ask: () => setAgain((n) => n + 1) };
}

function Rows({ title, of }: { title: string; of: Record<string, string | number | boolean | null> }) {
  return (
    <Scroll label={title}>
      <table>
        <caption>{title}</caption>
        <tbody>{Object.entries(of).filter(([, value]) => typeof value !== "object" || value === null).map(([name, value]) => (
          <tr><th scope="row">{name.replace(/_(ms|us|um)$/, " [$1]").replace(/_/g, " ")}</th><td class="n">{typeof value === "number" ? value.toLocaleString("en") : String(value ?? kNone)}</td></tr>
        ))}</tbody>
      </table>
    </Scroll>
  );
}

/** The largest correction that may be sent [um]; null if it is not known. */
function allowedUm(limits: Monitor["limits"]): number | null {
  const most = limits?.max_correction_mm ?? null;
  if (most === null || !limits) return null;
  return 1000 * (limits.mode === "limited" ? Math.min(most, limits.limited_mm) : most);
}

function Live({ status, past, limits, children }: { status: Status; past: Moment[]; limits: Monitor["limits"]; children: ComponentChildren }) {
  const allowed = allowedUm(limits);
  const cycle = limits?.cycle_us ?? null;
  const seconds = past.map((m) => m.seconds);
  return (
    <>
      <Card title="State">
        <p class={`verdict ${status.state === "active" ? "good" : status.state === "fault" ? "bad" : "partly"}`} id="rt-state">{status.state}: {kStateWords[status.state] ?? ""}</p>
        <dl class="facts">
          <div><dt>Mode</dt><dd>{modeWords(status.mode)}</dd></div>
          <div><dt>Status of the last correction</dt><dd>{status.status}</dd></div>
          <div><dt>Last fault</dt><dd>{status.fault}</dd></div>
          {status.lost.length > 0 && <div><dt>Held by</dt><dd>{status.lost.join(", ")}</dd></div>}
          <div><dt>Correction now</dt><dd id="correction"><strong>{plain(status.correction.applied_um)} um</strong>{allowed === null ? "" : ` of ${plain(allowed)} um allowed`}</dd></div>
          <div><dt>Cycle works</dt><dd>{plain(status.work.median_us)} us median, {plain(status.work.worst_us)} us longest{cycle === null ? "" : ` of ${cycle} us`}</dd></div>
          <div><dt>Model</dt><dd>{String(status.model?.fingerprint ?? status.model?.number ?? kNone)}</dd></div>
        </dl>
      </Card>
      <Card title="Correction against its limit"><Series title="Correction on the target [um]" seconds={seconds} lines={[
        { label: "applied", values: past.map((m) => m.status.correction.applied_um), tone: "blue" },
        { label: "wanted", values: past.map((m) => m.status.correction.wanted_um), tone: "green", dashed: true },
        ...(allowed === null ? [] : [{ label: "limit", values: past.map(() => allowed), tone: "vermilion" as const, dashed: true }]),
      ]} /></Card>
      {children}
      <Card title="Cycle"><Series title="Work and wake-up of a cycle, 99 % [us]" seconds={seconds} lines={[
        { label: "work", values: past.map((m) => m.status.work.p99_us), tone: "blue" },
        { label: "wake-up", values: past.map((m) => m.status.wake.p99_us), tone: "green", dashed: true },
      ]} /></Card>
      <Card title="Numbers" class="wide whole"><div class="columns"><Rows title="Counters" of={status.counters} /><Rows title="Ages of the inputs" of={status.ages} /><Rows title="Bus" of={status.link} /><Rows title="Clock" of={status.clock} /></div></Card>
    </>
  );
}

export function MonitorScreen() {
  const folder = param("folder") ?? "deploy";
  const { now, past, problem, ask } = useMonitor(folder);
  const [refused, setRefused] = useState<Problem | null>(null);
  const act = (action: "start" | "stop"): void => {
    setRefused(null);
    postJson("/api/monitor", { action, folder }).then(ask, (error: unknown) => setRefused(problemOf(error)));
  };
  const running = now?.running === true;
  const twin = now?.stops && <TwinCard stops={now.stops} driving={now.twin === true} />;
  return (
    <>
      <Card title="plumb-rt" lead="A running correction, or a demonstration in which plumb-twin is the robot and no hardware is needed.">
        <div class="tools">
          <label>Folder of deploy <input type="text" value={folder} list="folders" onChange={(event) => setParams({ folder: event.currentTarget.value })} /></label>
          <datalist id="folders">{(now?.folders ?? []).map((name) => <option value={name} />)}</datalist>
          <button type="button" class={running ? "" : "main"} disabled={running} id="start-demonstration" onClick={() => act("start")}>Start the demonstration</button>
          <button type="button" disabled={!running && !now?.twin} id="stop-demonstration" onClick={() => act("stop")}>Stop</button>
        </div>
        <Command line={shellLine("plumb-rt", ["run", folder, "--priority", "0"])} />
        {now?.twin_command && <Command line={now.twin_command} />}
        <Command line={shellLine("plumb-rt", ["status", folder, "--json"])} />
        {now?.limits && !running && <p>The folder is deployed in mode {modeWords(now.limits.mode)}.</p>}
        {(refused ?? problem) && <ProblemBox problem={{ severity: "note", ...(refused ?? problem as Problem) }} />}
        {now && !running && <Empty to={now.folders?.length === 0 ? "ship" : undefined}>Nothing runs in {folder}. Ship writes the folder; then start the demonstration, or plumb-rt in a shell.</Empty>}
      </Card>
      {running && now?.status ? <Live status={now.status} past={past} limits={now.limits}>{twin}</Live> : twin}
      <Replay />
    </>
  );
}
