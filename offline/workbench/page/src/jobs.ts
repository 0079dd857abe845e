// SPDX-License-Identifier: Apache-2.0
// Verbs that the server runs for us. Each purpose (diagnose, add, ...) remembers its last job.
import { signal, type Signal } from "@preact/signals";
import { setParams } from "./hash";
import { ApiError, getJson, postJson, problemOf, remove } from "./api";
import type { Envelope, Job, Problem } from "./types";

export interface Task { job: Job | null; problem: Problem | null; args: string[]; busy: boolean }

export const jobs = signal<Record<number, Job>>({});
const tasks = new Map<string, Signal<Task>>();
const waiting = new Map<number, (job: Job) => void>();

export const kIdle: Task = { job: null, problem: null, args: [], busy: false };

export function task(purpose: string): Signal<Task> {
  let found = tasks.get(purpose);
  if (!found) tasks.set(purpose, (found = signal(kIdle)));
  return found;
}

export const isOver = (job: Job): boolean => !["waiting", "running"].includes(job.state);

/** Takes in what the server says of a job. */
export function told(job: Job): void {
  const known = jobs.value[job.job];
  const merged = { ...known, ...job, output: job.output ?? known?.output };
  jobs.value = { ...jobs.value, [job.job]: merged };
  for (const one of tasks.values())
    if (one.value.job?.job === job.job) one.value = { ...one.value, job: merged };
  if (isOver(job)) {
    waiting.get(job.job)?.(merged);
    waiting.delete(job.job);
  }
}

const kMakeRuns = new Set(["add", "drop", "fit"]);
const kPoll = 1000; // [ms] when the socket says nothing

function ended(number: number): Promise<Job> {
  return new Promise((resolve) => {
    const timer = window.setInterval(() => {
      getJson<Job>(`/api/jobs/${number}`).then(told).catch((error: unknown) => {
        if (error instanceof ApiError && error.status === 404)
          told({ job: number, verb: "", command: "", state: "stopped", progress: [], exit: null, seconds: null });
      });
    }, kPoll);
    waiting.set(number, (job) => {
      clearInterval(timer);
      resolve(job);
    });
  });
}

/** Runs a verb and waits for its end. Never throws: the task carries the problem. */
export async function run(purpose: string, verb: string, args: string[]): Promise<Envelope | null> {
  const mine = task(purpose);
  if (mine.value.busy) return null;
  mine.value = { job: null, problem: null, args, busy: true };
  try {
    const { job, command } = await postJson<{ job: number; command: string }>("/api/jobs", { verb, args });
    const end = ended(job);
    const started: Job = { job, verb, args, command, state: "waiting", progress: [], exit: null, seconds: null };
    mine.value = { ...mine.value, job: started };
    told(started);
    let last = await end;
    if (last.output === undefined || last.output === null) {
      last = await getJson<Job>(`/api/jobs/${job}`);
      told(last);
    }
    const problem = last.output?.error ??
      (last.state === "failed" ? { code: "", message: last.progress[last.progress.length - 1] ?? "The command failed." } : null);
    mine.value = { job: jobs.value[job], problem, args, busy: false };
    if (!problem && kMakeRuns.has(verb) && !args.includes("--dry-run")) setParams({ run: null }); // the new run is the one to look at
    return last.output ?? null;
  } catch (error) {
    mine.value = { ...mine.value, problem: problemOf(error), busy: false };
    return null;
  }
}

export const stop = (job: number): void => {
  remove(`/api/jobs/${job}`).catch(() => undefined);
};

/** The last result of a purpose; null if there is none. */
export const resultOf = <T>(purpose: string): T | null =>
  (task(purpose).value.job?.output?.result as T | null | undefined) ?? null;

/** After a reload: results that the server still knows come back. */
export async function recall(purposes: Record<string, string>): Promise<void> {
  const { jobs: known } = await getJson<{ jobs: Job[] }>("/api/jobs");
  for (const [purpose, verb] of Object.entries(purposes)) {
    if (task(purpose).value.job) continue;
    const last = [...known].reverse().find((job) => job.verb === verb && job.state === "done");
    if (!last) continue;
    const full = await getJson<Job>(`/api/jobs/${last.job}`);
    told(full);
    task(purpose).value = { job: full, problem: null, args: full.args ?? [], busy: false };
  }
}
