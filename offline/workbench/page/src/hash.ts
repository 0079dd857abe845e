// SPDX-License-Identifier: Apache-2.0
// What is looked at stands in the address: #see?run=3&row=17. A copied address shows the same.
import { computed, signal } from "@preact/signals";

export const kScreens = ["data", "see", "learn", "improve", "ship", "monitor", "report"] as const;
export type Screen = (typeof kScreens)[number];

export const kScreenNames: Record<Screen, string> = {
  data: "Data", see: "See", learn: "Learn", improve: "Improve", ship: "Ship", monitor: "Monitor", report: "Report",
};

interface View { screen: Screen; params: Record<string, string> }

function read(): View {
  const [name, query] = location.hash.slice(1).split("?");
  const screen = kScreens.find((s) => s === name) ?? "see";
  return { screen, params: Object.fromEntries(new URLSearchParams(query ?? "")) };
}

function text({ screen, params }: View): string {
  const query = new URLSearchParams(params).toString();
  return `#${screen}${query === "" ? "" : `?${query}`}`;
}

export const view = signal<View>(read());
export const screen = computed(() => view.value.screen);

export const param = (name: string): string | undefined => view.value.params[name];

export function setParams(change: Record<string, string | number | null>): void {
  const params = { ...view.value.params };
  for (const [key, value] of Object.entries(change)) {
    if (value === null) delete params[key];
    else params[key] = String(value);
  }
  view.value = { ...view.value, params };
  history.replaceState(null, "", text(view.value));
}

export function goTo(to: Screen): void {
  if (to === view.value.screen) return;
  view.value = { ...view.value, screen: to };
  history.pushState(null, "", text(view.value));
  requestAnimationFrame(() => document.getElementById("screen")?.focus({ preventScroll: true }));
  window.scrollTo(0, 0);
}

export function followAddress(): void {
  const again = (): void => { view.value = read(); };
  window.addEventListener("hashchange", again);
  window.addEventListener("popstate", again);
}
