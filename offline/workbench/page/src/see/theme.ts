// SPDX-License-Identifier: Apache-2.0
import { signal } from "@preact/signals";

// In the order of the tones of the figures.
const kTones = ["paper", "ink", "muted", "grid", "band", "blue", "vermilion", "green", "purple", "orange"] as const;
export type Tones = Record<(typeof kTones)[number], string>;

function read(): Tones {
  const style = getComputedStyle(document.documentElement);
  return Object.fromEntries(kTones.map((name, i) => [name, style.getPropertyValue(`--plumb-${i}`).trim() || "#808080"])) as Tones;
}

/** The colours of the present theme, for what is drawn on a canvas. */
export const tones = signal<Tones>(read());

matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { tones.value = read(); });
