// SPDX-License-Identifier: Apache-2.0
// A record of plumb-rt, read with the bus layout that `plumb dbc` prints. Lines are those of candump -L:
// (seconds.microseconds) interface id#data, or id##flags data for CAN FD.

export interface BusSignal { name: string; start: number; length: number; little: boolean; signed: boolean; scale: number; offset: number; unit: string }
export interface BusMessage { id: number; name: string; signals: BusSignal[] }

const kMessage = /^BO_ (\d+) (\w+):/;
const kSignal = /^\s*SG_ (\w+)\s*(?:[mM]\d*\s*)?: (\d+)\|(\d+)@([01])([+-]) \(([^,]+),([^)]+)\) \[[^\]]*\] "([^"]*)"/;
const kExtended = 0x80000000;

export function readDbc(text: string): BusMessage[] {
  const out: BusMessage[] = [];
  for (const line of text.split("\n")) {
    const message = kMessage.exec(line);
    if (message) out.push({ id: Number(message[1]) % kExtended, name: message[2], signals: [] });
    const found = kSignal.exec(line);
    if (found && out.length > 0)
      out[out.length - 1].signals.push({
        name: found[1], start: Number(found[2]), length: Number(found[3]), little: found[4] === "1", signed: found[5] === "-",
        scale: Number(found[6]), offset: Number(found[7]), unit: found[8],
      });
  }
  return out;
}

function bytesOf(hex: string): number[] {
  return (hex.match(/../g) ?? []).map((pair) => parseInt(pair, 16));
}

/** Value of a little-endian signal of at most 53 bits, in its unit; null if the frame is too short. */
export function valueOf(signal: BusSignal, data: number[]): number | null {
  if (!signal.little || signal.start + signal.length > 8 * data.length) return null;
  let value = 0;
  for (let k = signal.length - 1; k >= 0; --k) {
    const bit = signal.start + k;
    value = 2 * value + ((data[bit >> 3] >> (bit & 7)) & 1);
  }
  if (signal.signed && value >= 2 ** (signal.length - 1)) value -= 2 ** signal.length;
  return value * signal.scale + signal.offset;
}

export interface Sample { seconds: number; values: Map<string, number> }
export interface Recorded { samples: Sample[]; names: string[]; ticks: number; gaps: number; unreadable: number }

const kLine = /^\((\d+)\.(\d+)\) (\S+) ([0-9A-Fa-f]+)#(#[0-9A-Fa-f])?([0-9A-Fa-f]*)/;
const kMostSamples = 5000;

/** What was known after each frame, thinned to at most 5000 samples. */
export function readRecord(text: string, layout: BusMessage[]): Recorded {
  const byId = new Map(layout.map((message) => [message.id, message]));
  const lines = text.split("\n");
  const every = Math.max(1, Math.ceil(lines.length / kMostSamples));
  const now = new Map<string, number>();
  const out: Recorded = { samples: [], names: [], ticks: 0, gaps: 0, unreadable: 0 };
  const names = new Set<string>();
  let first: number | null = null;
  lines.forEach((line, i) => {
    if (line.trim() === "") return;
    const found = kLine.exec(line);
    if (!found) {
      ++out.unreadable;
      return;
    }
    const seconds = Number(found[1]) + Number(found[2]) * 10 ** -found[2].length;
    first ??= seconds;
    if (found[3] === "tick") ++out.ticks;
    if (found[3] === "gap") ++out.gaps;
    const message = byId.get(parseInt(found[4], 16));
    if (message && !["tick", "unsent", "gap"].includes(found[3]))
      for (const signal of message.signals) {
        const value = valueOf(signal, bytesOf(found[6]));
        const name = `${message.name}.${signal.name}${signal.unit ? ` [${signal.unit}]` : ""}`;
        if (value !== null) {
          now.set(name, value);
          names.add(name);
        }
      }
    if (i % every === 0) out.samples.push({ seconds: seconds - first, values: new Map(now) });
  });
  out.names = [...names].sort();
  return out;
}
