// SPDX-License-Identifier: Apache-2.0
import uPlot from "uplot";
import { useEffect, useRef } from "preact/hooks";
import { tones } from "../see/theme";

export interface Line { label: string; values: (number | null)[]; tone: "blue" | "vermilion" | "green" | "muted"; dashed?: boolean }

const kHeight = 190; // [px]

/** Lines over the seconds since the beginning. */
export function Series({ title, seconds, lines }: { title: string; seconds: number[]; lines: Line[] }) {
  const host = useRef<HTMLDivElement>(null), plot = useRef<uPlot | null>(null);
  const theme = tones.value;
  const labels = lines.map(({ label }) => label).join();
  useEffect(() => {
    const element = host.current;
    if (!element) return;
    const axis = { stroke: theme.muted, grid: { stroke: theme.grid, width: 1 }, ticks: { stroke: theme.grid, width: 1 } };
    const made = new uPlot({
      width: Math.max(200, element.clientWidth), height: kHeight, legend: { live: false }, cursor: { drag: { x: false, y: false } },
      scales: { x: { time: false, range: (_, low, high) => [low ?? 0, (high ?? 0) > (low ?? 0) ? high : (low ?? 0) + 1] }, y: { range: (_, __, high) => [0, (high || 1) * 1.1] } },
      axes: [{ ...axis, label: "time [s]", labelSize: 18, labelFont: "12px system-ui, sans-serif", size: 30 }, { ...axis, size: 56 }],
      series: [{ label: "s" }, ...lines.map(({ label, tone, dashed }) => ({ label, stroke: theme[tone], width: 2, dash: dashed ? [6, 4] : undefined, points: { show: false } }))],
    }, [seconds, ...lines.map(({ values }) => values)] as uPlot.AlignedData, element);
    plot.current = made;
    const watch = new ResizeObserver(() => made.setSize({ width: Math.max(200, element.clientWidth), height: kHeight }));
    watch.observe(element);
    return () => {
      watch.disconnect();
      made.destroy();
    };
  }, [theme, labels]);
  useEffect(() => plot.current?.setData([seconds, ...lines.map(({ values }) => values)] as uPlot.AlignedData), [seconds, lines]);
  return <div class="series" role="group" aria-label={title}><p class="caption">{title}</p><div ref={host} /></div>;
}
