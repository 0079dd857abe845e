// SPDX-License-Identifier: Apache-2.0
// What stands on top of every screen.
import { setParams } from "./hash";
import { mm, withMm } from "./numbers";
import { cell, runDetail, runNumber, runRow } from "./store";
import { connection } from "./connection";
import { verdict } from "./verdict";

function RunChoice() {
  const runs = cell.value?.runs ?? [];
  if (runs.length === 0) return <span>none</span>;
  return (
    <select aria-label="Run" value={String(runNumber.value)}
      onChange={(event) => setParams({ run: event.currentTarget.value })}>
      {[...runs].filter((run) => !run.damaged).reverse().map((run) => (
        <option value={String(run.run)}>{run.run}{run.current ? ", present" : ""}: {run.verdict_error ? mm(run.verdict_error.mean_mm) : "not held out"}</option>
      ))}
    </select>
  );
}

export function Header() {
  const detail = runDetail.value, held = detail?.verdict_error ?? runRow.value?.verdict_error ?? null;
  const { word, kind, sentence } = verdict.value;
  const name = cell.value?.cell?.name ?? "";
  return (
    <header class="top">
      <dl>
        <div class="name"><dt>Cell</dt><dd title={cell.value?.cell?.folder}>{name || "–"}</dd></div>
        <div><dt>Run</dt><dd><RunChoice /></dd></div>
        <div><dt>Held-out error</dt><dd id="held-out" class="big">{held && held.n > 0 ? withMm(held.mean_mm) : "–"}</dd></div>
        <div><dt>Noise floor</dt><dd>{detail ? withMm(detail.noise_floor_mm) : "–"}</dd></div>
        <div><dt>Tolerance</dt><dd>{withMm(cell.value?.cell?.tolerance_mm)}</dd></div>
      </dl>
      <p id="verdict" class={`verdict ${kind}`} title={sentence}>{word}</p>
    </header>
  );
}

export function ConnectionNote() {
  if (connection.value === "other")
    return <p class="lost" role="alert">The server was started again. This page shows what it sends, but may not change anything: open the address that it printed.</p>;
  if (connection.value !== "lost") return null;
  return (
    <p class="lost" role="alert">
      The server does not answer. Nothing here is lost; this page connects again by itself when it runs: <code>{cell.value?.command ?? "plumb"} serve</code>. A server on another port has another address: open the one it prints.
    </p>
  );
}
