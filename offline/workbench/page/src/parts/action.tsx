// SPDX-License-Identifier: Apache-2.0
// A button that runs a verb, with its command line, its progress and its problem.
import type { ComponentChildren } from "preact";
import { isOver, run, stop, task } from "../jobs";
import type { Envelope } from "../types";
import { Command } from "./command";
import { ProblemBox } from "./problem";

const kLines = 6; // of progress that are shown

const kStateWords = {
  waiting: "Waiting for another command to end", running: "Running", done: "Done", failed: "Failed", stopped: "Stopped",
} as const;

/** With `warnings` false the caller shows them itself. */
export function Progress({ purpose, warnings = true }: { purpose: string; warnings?: boolean }) {
  const { job, busy, problem } = task(purpose).value;
  return (
    <>
      {job && busy && (
        <div class="progress" role="status">
          <p><span class="spinner" aria-hidden="true" /> {kStateWords[job.state]}{job.seconds ? `, ${Math.round(job.seconds)} s` : ""}
            {!isOver(job) && <button type="button" class="small" onClick={() => stop(job.job)}>Stop</button>}</p>
          {job.progress.length > 0 && <pre>{job.progress.slice(-kLines).join("\n")}</pre>}
        </div>
      )}
      {problem && <ProblemBox problem={problem} />}
      {warnings && (job?.output?.warnings ?? []).map((warning) => <ProblemBox problem={warning} />)}
    </>
  );
}

interface ActionProps {
  purpose: string;
  verb: string;
  args?: string[];
  children: ComponentChildren;
  label?: string;
  main?: boolean;
  disabled?: boolean;
  quiet?: boolean;
  id?: string;
  shortcut?: string;
  onDone?: (output: Envelope) => void;
}

export function Action({ purpose, verb, args = [], children, label, main, disabled, quiet, id, shortcut, onDone }: ActionProps) {
  const { busy } = task(purpose).value;
  const onClick = (): void => {
    void run(purpose, verb, args).then((output) => { if (output?.ok) onDone?.(output); });
  };
  return (
    <div class="action">
      <button type="button" id={id} class={main ? "main" : ""} aria-label={label} aria-keyshortcuts={shortcut}
        disabled={busy || disabled} onClick={onClick}>{children}</button>
      <Command words={[verb, ...args]} />
      {!quiet && <Progress purpose={purpose} />}
    </div>
  );
}
