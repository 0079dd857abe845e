// SPDX-License-Identifier: Apache-2.0
/**
 * An order of 0 ... n-1 whose every beginning is spread evenly over the whole: `first` come first, then
 * halves, quarters, and so on. Drawing the first m of it thins out without favouring a region.
 */
export function spreadOrder(n: number, first: Iterable<number>): number[] {
  const out: number[] = [];
  const taken = new Uint8Array(n);
  const take = (i: number): void => {
    if (i < n && !taken[i]) {
      taken[i] = 1;
      out.push(i);
    }
  };
  for (const i of first) take(i);
  let stride = 1;
  while (stride < n) stride *= 2;
  for (; stride >= 1; stride /= 2)
    for (let i = 0; i < n; i += stride) take(i);
  return out;
}
