// SPDX-License-Identifier: Apache-2.0
// A foreign file as plumb import understands it; the meaning of a column can be changed.
import { useState } from "preact/hooks";
import { resultOf, task } from "../jobs";
import { Action } from "../parts/action";
import { Scroll } from "../parts/card";

interface Imported {
  rows: number; separator: string; decimal: string;
  columns: { from: string; to: string; first: string; last: string }[];
  left_out: string[];
}

const kOut = "measurements.csv";

/** Columns of measurements.csv, to choose from. */
const kMeanings = ["pose", "set", "x_mm", "y_mm", "z_mm", "x_m", "y_m", "z_m", "x_um", "y_um", "z_um", "sx_mm", "sy_mm", "sz_mm",
  "q1_deg", "q2_deg", "q3_deg", "q4_deg", "q5_deg", "q6_deg", "q1_rad", "q2_rad", "q3_rad", "q4_rad", "q5_rad", "q6_rad",
  "payload_kg", "temp_degC", "time"];

export function ImportPanel({ name }: { name: string }) {
  const [maps, setMaps] = useState<Record<string, string>>({});
  const words = Object.entries(maps).filter(([, to]) => to !== "").flatMap(([from, to]) => ["--map", `${from}=${to}`]);
  const seen = resultOf<Imported>("import"), { args, busy } = task("import").value;
  const mine = seen && args[0] === name && !busy;
  const rows = mine ? [...seen.columns.filter(({ from }) => from !== ""), ...seen.left_out.map((from) => ({ from, to: "", first: "", last: "" }))] : [];
  return (
    <>
      <Action purpose="import" verb="import" args={[name, ...words, "--preview"]}>Preview as understood</Action>
      {mine && (
        <>
          <p role="status">Understood {seen.rows} rows; separated by {seen.separator}, decimal {seen.decimal}.</p>
          <Scroll label="Columns as understood">
            <table>
              <thead><tr><th scope="col">In the file</th><th scope="col">Taken as</th><th scope="col">First</th><th scope="col">Last</th><th scope="col">Change to</th></tr></thead>
              <tbody>{rows.map(({ from, to, first, last }) => (
                <tr key={from}><th scope="row">{from}</th><td>{to || "left out"}</td><td class="n">{first}</td><td class="n">{last}</td>
                  <td><select aria-label={`Meaning of column ${from}`} value={maps[from] ?? ""} onChange={(event) => setMaps({ ...maps, [from]: event.currentTarget.value })}>
                    <option value="">as guessed</option><option value="-">leave it out</option>{kMeanings.map((m) => <option>{m}</option>)}
                  </select></td></tr>
              ))}</tbody>
            </table>
          </Scroll>
          <Action purpose="import-write" verb="import" args={[name, ...words, "-o", kOut, "--force"]}>Write {kOut}</Action>
        </>
      )}
    </>
  );
}
