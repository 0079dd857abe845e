// SPDX-License-Identifier: Apache-2.0
// Numbers as they are shown: mm with three digits behind the point, a dash where there is none.
export const kNone = "–";

export function mm(x: number | null | undefined, digits = 3): string {
  return x === null || x === undefined || !Number.isFinite(x) ? kNone : x.toFixed(digits);
}

export const withMm = (x: number | null | undefined): string =>
  x === null || x === undefined ? "unknown" : `${mm(x)} mm`;

export function plain(x: number | null | undefined): string {
  if (x === null || x === undefined || !Number.isFinite(x)) return kNone;
  const size = Math.abs(x);
  if (size !== 0 && (size < 1e-3 || size >= 1e6)) return x.toExponential(2);
  return String(Number(x.toPrecision(4)));
}

export const count = (n: number, noun: string): string => `${n.toLocaleString("en")} ${noun}${n === 1 ? "" : "s"}`;

export const bytes = (n: number): string =>
  n < 1000 ? `${n} B` : n < 1e6 ? `${(n / 1e3).toFixed(1)} kB` : `${(n / 1e6).toFixed(1)} MB`;

/** The nearest of 1, 2, 5 times a power of ten below x. */
export function roundDown125(x: number): number {
  const power = 10 ** Math.floor(Math.log10(x));
  const lead = x / power;
  return power * (lead >= 5 ? 5 : lead >= 2 ? 2 : 1);
}
