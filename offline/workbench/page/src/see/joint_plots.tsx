// SPDX-License-Identifier: Apache-2.0
// Error after calibration over each joint. A band dragged over one plot keeps only its poses everywhere.
import { useEffect, useRef, useState } from "preact/hooks";
import { setParams } from "../hash";
import { mm, plain } from "../numbers";
import { brush, brushed, joints, pick, picked, poses } from "../store";
import type { Poses } from "../types";
import { tones, type Tones } from "./theme";

const kLeft = 34, kRight = 8, kTop = 8, kBottom = 20, kHeight = 130; // [px]
const kNear = 12; // [px]: a click picks a pose within it

interface Axis { low: number; high: number }

function rangeOf(values: (number | null)[]): Axis {
  let low = Infinity, high = -Infinity;
  for (const x of values)
    if (x !== null) {
      low = Math.min(low, x);
      high = Math.max(high, x);
    }
  if (!(low < high)) return Number.isFinite(low) ? { low: low - 1, high: low + 1 } : { low: 0, high: 1 };
  return { low, high };
}

interface Plot { width: number; x: Axis; top: number }

const xAt = (p: Plot, q: number): number => kLeft + (q - p.x.low) / (p.x.high - p.x.low) * (p.width - kLeft - kRight);
const qAt = (p: Plot, x: number): number => p.x.low + (x - kLeft) / (p.width - kLeft - kRight) * (p.x.high - p.x.low);
const yAt = (p: Plot, e: number): number => kHeight - kBottom - e / p.top * (kHeight - kTop - kBottom);

function cleared(canvas: HTMLCanvasElement, plot: Plot): CanvasRenderingContext2D | null {
  const scale = devicePixelRatio;
  canvas.width = Math.round(plot.width * scale);
  canvas.height = Math.round(kHeight * scale);
  const c = canvas.getContext("2d");
  c?.scale(scale, scale);
  return c;
}

function dot(c: CanvasRenderingContext2D, all: Poses, joint: number, plot: Plot, i: number, r: number): void {
  const q = all.q[joint][i], e = all.after_norm_mm[i];
  if (q === null || q === undefined || e === null) return;
  c.beginPath();
  c.arc(xAt(plot, q), yAt(plot, e), r, 0, 2 * Math.PI);
  if (all.set[i] === "held") c.fill();
  else c.stroke();
}

function paint(canvas: HTMLCanvasElement, all: Poses, joint: number, plot: Plot, theme: Tones, inside: Set<number> | null, band: Axis | null): void {
  const c = cleared(canvas, plot);
  if (!c) return;
  if (band) {
    c.fillStyle = theme.band;
    c.fillRect(xAt(plot, band.low), kTop, xAt(plot, band.high) - xAt(plot, band.low), kHeight - kTop - kBottom);
  }
  c.strokeStyle = theme.muted;
  c.strokeRect(kLeft + 0.5, kTop + 0.5, plot.width - kLeft - kRight - 1, kHeight - kTop - kBottom - 1);
  c.fillStyle = theme.muted;
  c.font = "11px system-ui, sans-serif";
  c.textAlign = "right";
  c.fillText(plot.top.toPrecision(2), kLeft - 3, kTop + 9);
  c.fillText("0", kLeft - 3, kHeight - kBottom);
  c.textAlign = "left";
  c.fillText(plain(Math.round(plot.x.low)), kLeft, kHeight - 6);
  c.textAlign = "right";
  c.fillText(plain(Math.round(plot.x.high)), plot.width - kRight, kHeight - 6);
  c.lineWidth = 1;
  all.row.forEach((_, i) => {
    const lit = inside === null || inside.has(i);
    c.fillStyle = c.strokeStyle = lit ? theme.blue : theme.grid;
    dot(c, all, joint, plot, i, 2);
  });
}

/** The picked pose, on a canvas of its own: walking through poses redraws nothing else. */
function paintPicked(canvas: HTMLCanvasElement, all: Poses, joint: number, plot: Plot, theme: Tones, at: number): void {
  const c = cleared(canvas, plot);
  if (!c) return;
  c.fillStyle = c.strokeStyle = theme.vermilion;
  c.lineWidth = 2;
  dot(c, all, joint, plot, at, 5);
}

function JointPlot({ joint, all }: { joint: number; all: Poses }) {
  const canvas = useRef<HTMLCanvasElement>(null), mark = useRef<HTMLCanvasElement>(null);
  const [width, setWidth] = useState(0);
  const [drag, setDrag] = useState<{ from: number; to: number } | null>(null);
  const theme = tones.value, inside = brushed.value, at = picked.value, chosen = brush.value;
  const plot: Plot = { width, x: rangeOf(all.q[joint]), top: rangeOf(all.after_norm_mm).high || 1 };
  const name = joints.value[joint]?.name ?? `J${joint + 1}`, unit = all.q_units[joint] ?? "deg";
  const band = drag ? { low: Math.min(drag.from, drag.to), high: Math.max(drag.from, drag.to) }
    : chosen?.joint === joint ? { low: chosen.from, high: chosen.to } : null;

  useEffect(() => {
    const element = canvas.current;
    if (!element) return;
    const watch = new ResizeObserver(() => setWidth(element.clientWidth));
    watch.observe(element);
    return () => watch.disconnect();
  }, []);
  useEffect(() => {
    if (canvas.current && width > 0) paint(canvas.current, all, joint, plot, theme, inside, band);
  }, [all, width, theme, inside, band?.low, band?.high]);
  useEffect(() => {
    if (mark.current && width > 0) paintPicked(mark.current, all, joint, plot, theme, at);
  }, [all, width, theme, at]);

  const place = (event: PointerEvent): number =>
    Math.min(plot.x.high, Math.max(plot.x.low, qAt(plot, event.offsetX)));
  const onUp = (event: PointerEvent): void => {
    setDrag(null);
    if (drag && Math.abs(xAt(plot, drag.from) - xAt(plot, drag.to)) > 4) {
      setParams({ brush: `${joint}:${band?.low.toFixed(2)}:${band?.high.toFixed(2)}` });
      return;
    }
    let best = -1, nearest = kNear;
    all.row.forEach((_, i) => {
      const q = all.q[joint][i], e = all.after_norm_mm[i];
      if (q === null || e === null) return;
      const far = Math.hypot(xAt(plot, q) - event.offsetX, yAt(plot, e) - event.offsetY);
      if (far < nearest) [best, nearest] = [i, far];
    });
    if (best >= 0) pick(best);
    else if (chosen) setParams({ brush: null });
  };
  return (
    <figure class="joint-plot">
      <figcaption>{name} [{unit}], error [mm]</figcaption>
      <div class="layers">
      <canvas ref={canvas} role="img" aria-label={`Error after calibration over ${name}; largest ${mm(plot.top)} mm`}
        onPointerDown={(event) => { event.currentTarget.setPointerCapture(event.pointerId); setDrag({ from: place(event), to: place(event) }); }}
        onPointerMove={(event) => { if (drag) setDrag({ ...drag, to: place(event) }); }}
        onPointerUp={onUp} onPointerCancel={() => setDrag(null)} />
      <canvas ref={mark} class="mark" aria-hidden="true" />
      </div>
    </figure>
  );
}

/** The band in numbers: the same by keyboard. */
function BandFields({ all }: { all: Poses }) {
  const chosen = brush.value;
  const set = (change: Partial<{ joint: number; from: number; to: number }>): void => {
    const joint = change.joint ?? chosen?.joint ?? 0;
    const whole = rangeOf(all.q[joint] ?? []);
    const base = chosen && change.joint === undefined ? chosen : { from: whole.low, to: whole.high };
    setParams({ brush: `${joint}:${change.from ?? base.from.toFixed(1)}:${change.to ?? base.to.toFixed(1)}` });
  };
  const field = (label: string, key: "from" | "to"): preact.JSX.Element => (
    <label>{label} <input type="number" step="any" disabled={!chosen} value={chosen ? String(chosen[key]) : ""}
      onChange={(event) => { if (event.currentTarget.value !== "") set({ [key]: event.currentTarget.valueAsNumber }); }} /></label>
  );
  return (
    <div class="tools">
      <label>Only poses with
        <select value={chosen ? String(chosen.joint) : ""} onChange={(event) =>
          event.currentTarget.value === "" ? setParams({ brush: null }) : set({ joint: Number(event.currentTarget.value) })}>
          <option value="">any joint</option>
          {all.q.map((_, j) => <option value={String(j)}>{joints.value[j]?.name ?? `J${j + 1}`}</option>)}
        </select>
      </label>
      {field("from", "from")}
      {field("to", "to")}
      {chosen && <button type="button" onClick={() => setParams({ brush: null })}>Show all poses</button>}
      {chosen && <span role="status">{brushed.value?.size ?? 0} of {all.row.length} poses</span>}
    </div>
  );
}

export function JointPlots() {
  const all = poses.value;
  if (!all) return null;
  return (
    <>
      <p class="lead">Filled: held out; hollow: fitted. Drag a band over a plot to keep its poses only, click to pick one.</p>
      <BandFields all={all} />
      <div class="joint-plots">{all.q.map((_, j) => <JointPlot joint={j} all={all} />)}</div>
    </>
  );
}
