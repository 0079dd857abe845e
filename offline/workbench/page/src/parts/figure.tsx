// SPDX-License-Identifier: Apache-2.0
// A figure of the server, laid out for the room it has. Its marks of poses are picked with the rest
// of the page. The style sheet inside the file becomes one of the page: the policy of the page allows
// no style elements.
import { useEffect, useRef, useState } from "preact/hooks";
import { ApiError, getText, problemOf } from "../api";
import { pickByName, pickedPose, runNumber, state } from "../store";
import type { Problem } from "../types";
import { ProblemBox } from "./problem";

let adopted = "";

function adoptStyle(text: string): void {
  if (text === adopted || text === "") return;
  adopted = text;
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(text);
  document.adoptedStyleSheets = [sheet];
}

const kStyle = /<style[^>]*>([\s\S]*?)<\/style>/g;

/** The drawing as elements; nothing in it can run. */
function drawing(text: string): Element | null {
  const style = [...text.matchAll(kStyle)].map((found) => found[1]).join("\n");
  const parsed = new DOMParser().parseFromString(text.replace(kStyle, ""), "image/svg+xml").documentElement;
  if (parsed.tagName !== "svg") return null;
  for (const element of [...parsed.querySelectorAll("script, foreignObject, a, use, image")]) element.remove();
  for (const element of [parsed, ...parsed.querySelectorAll("*")])
    for (const { name } of [...element.attributes])
      if (name.startsWith("on") || name === "style" || name.endsWith("href")) element.removeAttribute(name);
  adoptStyle(style.replace(/<!\[CDATA\[|\]\]>/g, ""));
  return document.importNode(parsed, true);
}

const kStep = 20, kNarrowest = 320, kWidest = 1280; // [px]

function roundedWidth(room: number): number {
  return Math.max(kNarrowest, Math.min(kWidest, kStep * Math.floor(room / kStep)));
}

function mark(host: HTMLElement, pose: string | null): void {
  for (const old of host.querySelectorAll(".picked-pose")) old.classList.remove("picked-pose");
  if (pose === null) return;
  for (const element of host.querySelectorAll(`[data-pose="${CSS.escape(pose)}"]`)) element.classList.add("picked-pose");
}

function pickHit(event: MouseEvent): void {
  const hit = (event.target as Element).closest("[data-pose]");
  if (hit) pickByName(hit.getAttribute("data-pose") ?? "");
}

/** A figure that is here already, as the text of its file. */
export function Drawn({ name, text }: { name: string; text: string }) {
  const host = useRef<HTMLDivElement>(null);
  const pose = pickedPose.value;
  useEffect(() => {
    const element = host.current, svg = drawing(text);
    if (!element || !svg) return;
    element.replaceChildren(svg);
    mark(element, pickedPose.peek());
  }, [text]);
  useEffect(() => { if (host.current) mark(host.current, pose); }, [pose]);
  return <figure class="figure" data-figure={name}><div ref={host} onClick={pickHit} /></figure>;
}

interface FigureProps { name: string; path?: string; label?: string }

export function Figure({ name, path, label }: FigureProps) {
  const host = useRef<HTMLDivElement>(null);
  const [width, setWidth] = useState(0);
  const [problem, setProblem] = useState<Problem | null>(null);
  const [busy, setBusy] = useState(true);
  const run = runNumber.value, pose = pickedPose.value, version = state.value;

  useEffect(() => {
    const element = host.current;
    if (!element) return;
    const watch = new ResizeObserver(() => setWidth(roundedWidth(element.clientWidth)));
    watch.observe(element);
    return () => watch.disconnect();
  }, []);

  useEffect(() => {
    const element = host.current;
    if (!element || width === 0 || (run === null && !path)) return;
    const loading = new AbortController();
    const query = new URLSearchParams({ width: String(width), state: String(version) });
    if (run !== null) query.set("run", String(run));
    setBusy(true);
    getText(path ?? `/fig/${encodeURIComponent(name)}.svg?${query}`, loading.signal)
      .then((text) => {
        const svg = drawing(text);
        if (!svg) throw new ApiError(0, { code: "", message: `The figure ${name} cannot be read.` });
        if (label) svg.setAttribute("aria-label", label);
        element.replaceChildren(svg);
        mark(element, pickedPose.peek());
        setProblem(null);
      })
      .catch((error: unknown) => {
        if (loading.signal.aborted) return;
        element.replaceChildren();
        setProblem(problemOf(error));
      })
      .finally(() => { if (!loading.signal.aborted) setBusy(false); });
    return () => loading.abort();
  }, [name, path, width, run, version]);

  useEffect(() => { if (host.current) mark(host.current, pose); }, [pose]);

  return (
    <figure class="figure" data-figure={name} aria-busy={busy}>
      {busy && !problem && <p class="muted">Drawing {name} …</p>}
      <div ref={host} onClick={pickHit} />
      {problem && <ProblemBox problem={{ ...problem, severity: "note" }} />}
    </figure>
  );
}
