// SPDX-License-Identifier: Apache-2.0
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { getJson } from "../api";
import { param, setParams } from "../hash";
import { plain, roundDown125 } from "../numbers";
import { Figure } from "../parts/figure";
import { brushed, pick, picked, poses, runNumber } from "../store";
import type { Frames, Poses } from "../types";
import { View3d, type Eye, type Shown } from "./scene";
import { tones } from "./theme";

const kEyeNames: Record<Eye, string> = { orbit: "Orbit", top: "Top", side: "Side", front: "Front" };
const kShownNames: Record<Shown, string> = { both: "Before and after", before: "Before", after: "After" };
const kArrowShare = 0.12; // of the reach: length of the 95 % error before, if no factor is chosen

/** The scale stays the same for before and after, and for all runs: it is made of the error before. */
function usualFactor(all: Poses): number {
  const sorted = all.before_norm_mm.filter((x): x is number => x !== null).sort((a, b) => a - b);
  const p95 = sorted[Math.floor(0.95 * (sorted.length - 1))] ?? 0;
  return p95 > 0 ? Math.max(1, roundDown125(kArrowShare * (all.reach_mm ?? 1000) / p95)) : 1;
}

const kFactors = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000, 20000, 50000];

function Choice<T extends string>({ name, label, value, names }: { name: string; label: string; value: T; names: Record<T, string> }) {
  return (
    <fieldset class="choice">
      <legend>{label}</legend>
      {(Object.entries(names) as [T, string][]).map(([key, words]) => (
        <button type="button" aria-pressed={value === key} onClick={() => setParams({ [name]: key })}>{words}</button>
      ))}
    </fieldset>
  );
}

export function ArmView() {
  const canvas = useRef<HTMLCanvasElement>(null);
  const view = useRef<View3d | null>(null);
  const [failed, setFailed] = useState(false);
  const [thinned, setThinned] = useState<[number, number]>([0, 0]);
  const [frames, setFrames] = useState<Frames | null>(null);
  const all = poses.value, theme = tones.value, index = picked.value, inside = brushed.value, run = runNumber.value;
  const eye = (param("eye") ?? "orbit") as Eye, shown = (param("show") ?? "both") as Shown;
  const heldOnly = param("held") === "1", withFrames = param("frames") === "1", lit = param("region") !== "0";
  const usual = useMemo(() => (all ? usualFactor(all) : 1), [all]);
  const factor = Number(param("factor")) || usual;

  useEffect(() => {
    const element = canvas.current;
    if (!element) return;
    try {
      view.current = new View3d(element);
    } catch {
      setFailed(true);
      return;
    }
    view.current.onPick = pick;
    view.current.onThinned = (drawn, of) => setThinned((old) => (old[0] === drawn && old[1] === of ? old : [drawn, of]));
    const watch = new ResizeObserver(() => view.current?.resize(element.clientWidth, element.clientHeight));
    watch.observe(element);
    return () => {
      watch.disconnect();
      view.current?.dispose();
      view.current = null;
    };
  }, []);

  useEffect(() => {
    if (all)
      view.current?.showPoses({
        poses: all, shown, factor, heldOnly, brushed: inside, tones: theme,
        region: new Set(lit ? all.worst_region.rows : []),
      });
  }, [all, shown, factor, heldOnly, inside, lit, theme]);
  useEffect(() => view.current?.lookFrom(eye), [eye]);
  useEffect(() => view.current?.showPicked(index, theme), [all, index, theme]);
  useEffect(() => { if (frames) view.current?.showArm(frames, theme, withFrames); }, [frames, theme, withFrames]);

  const row = all?.row[index];
  useEffect(() => {
    if (row === undefined || run === null) return;
    const loading = new AbortController();
    getJson<Frames>(`/api/runs/${run}/frames?row=${row}`, loading.signal).then(setFrames).catch(() => undefined);
    return () => loading.abort();
  }, [row, run]);

  const onKeyDown = (event: KeyboardEvent): void => {
    const turns: Record<string, [number, number]> = { ArrowLeft: [0.15, 0], ArrowRight: [-0.15, 0], ArrowUp: [0, 0.15], ArrowDown: [0, -0.15] };
    const by = turns[event.key];
    if (by && eye === "orbit") view.current?.turn(...by);
    else if (event.key === "+") view.current?.zoom(1.25);
    else if (event.key === "-") view.current?.zoom(0.8);
    else return;
    event.preventDefault();
  };
  const [drawn, of] = thinned;
  if (failed)
    return (
      <>
        <p class="note">This browser has no WebGL. The figure shows the same arrows from three sides; the tables serve as they do elsewhere.</p>
        <Figure name="error-map" />
      </>
    );
  return (
    <div class="view3d">
      <div class="tools">
        <Choice name="eye" label="View" value={eye} names={kEyeNames} />
        <Choice name="show" label="Errors" value={shown} names={kShownNames} />
        <label>Arrows ×&nbsp;
          <select value={String(factor)} onChange={(event) => setParams({ factor: event.currentTarget.value })}>
            {[...new Set([...kFactors, factor])].sort((a, b) => a - b).map((f) => <option value={String(f)}>{f.toLocaleString("en")}</option>)}
          </select>
        </label>
        <label><input type="checkbox" checked={heldOnly} onChange={() => setParams({ held: heldOnly ? null : 1 })} /> held-out poses only</label>
        <label><input type="checkbox" checked={withFrames} onChange={() => setParams({ frames: withFrames ? null : 1 })} /> frames</label>
        <label><input type="checkbox" checked={lit} onChange={() => setParams({ region: lit ? 0 : null })} /> worst region</label>
      </div>
      <canvas ref={canvas} id="arm" tabIndex={0} role="img" onKeyDown={onKeyDown}
        aria-label="The arm at the picked pose, with error arrows at the measured points. Arrow keys turn it, + and - zoom. The table of the worst poses holds the same numbers." />
      <p class="legend">
        <span class="key before" /> before <span class="key after" /> after calibration
        {lit && (all?.worst_region.rows.length ?? 0) > 0 && <> <span class="key region" /> worst region</>}
        {" "}· one scale for both: an arrow is {factor.toLocaleString("en")} times the error, 10 mm on the grid stand for {plain(10000 / factor)} um
        {" "}· e = measured − predicted
        {drawn < of && <span role="status"> · {drawn.toLocaleString("en")} of {of.toLocaleString("en")} arrows are drawn, spread evenly, the 50 worst always</span>}
      </p>
    </div>
  );
}
