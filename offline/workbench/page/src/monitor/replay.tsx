// SPDX-License-Identifier: Apache-2.0
import { useState } from "preact/hooks";
import { run } from "../jobs";
import { count, plain } from "../numbers";
import { Progress } from "../parts/action";
import { Card, Scroll } from "../parts/card";
import { Command } from "../parts/command";
import { readDbc, readRecord, type Recorded } from "./record";
import { Series } from "./series";

export function Replay() {
  const [recorded, setRecorded] = useState<Recorded | null>(null);
  const [at, setAt] = useState(0);
  const [name, setName] = useState("");
  const [said, say] = useState("");
  const read = async (file: File | undefined): Promise<void> => {
    if (!file) return;
    say("Reading …");
    const layout = await run("dbc", "dbc", []);
    const text = typeof layout?.result?.dbc === "string" ? layout.result.dbc : "";
    const found = readRecord(await file.text(), readDbc(text));
    setRecorded(found);
    setAt(0);
    setName(found.names.find((n) => /corr/i.test(n)) ?? found.names[0] ?? "");
    say(found.samples.length === 0 ? "This is no record: lines as candump -L writes them are expected."
      : `${file.name}: ${count(found.ticks, "cycle")}, ${count(found.gaps, "gap")}${found.unreadable > 0 ? `, ${count(found.unreadable, "line")} that are no record` : ""}.`);
  };
  const sample = recorded?.samples[at];
  return (
    <Card title="Replay a record" class="wide" lead="What stood on the bus, moment by moment. The file is read by this page and goes nowhere.">
      <label>Record of plumb-rt <input type="file" accept=".log,.txt" onChange={(event) => void read(event.currentTarget.files?.[0])} /></label>
      <Command line="plumb-rt replay record.log --dir deploy" />
      <Progress purpose="dbc" />
      {said && <p role="status">{said}</p>}
      {recorded && sample && (
        <>
          <label>Moment: {sample.seconds.toFixed(3)} s
            <input type="range" min={0} max={recorded.samples.length - 1} value={at} onInput={(event) => setAt(event.currentTarget.valueAsNumber)} /></label>
          <label>Shown as a line <select value={name} onChange={(event) => setName(event.currentTarget.value)}>{recorded.names.map((n) => <option>{n}</option>)}</select></label>
          <Series title={name} seconds={recorded.samples.map((s) => s.seconds)} lines={[
            { label: name, values: recorded.samples.map((s) => s.values.get(name) ?? null), tone: "blue" },
            { label: "here", values: recorded.samples.map((s, i) => (i === at ? s.values.get(name) ?? null : null)), tone: "vermilion" },
          ]} />
          <Scroll label="Values at this moment">
            <table>
              <thead><tr><th scope="col">Signal</th><th scope="col">Value</th></tr></thead>
              <tbody>{recorded.names.map((n) => <tr key={n}><th scope="row">{n}</th><td class="n">{plain(sample.values.get(n))}</td></tr>)}</tbody>
            </table>
          </Scroll>
        </>
      )}
    </Card>
  );
}
