// SPDX-License-Identifier: Apache-2.0
import { useState } from "preact/hooks";
import { shellLine } from "../shell";
import { command } from "../store";

async function copy(text: string): Promise<void> {
  await navigator.clipboard.writeText(text);
}

/** The command line that does the same, with a button that copies it. */
export function Command({ words, line }: { words?: string[]; line?: string }) {
  const [said, say] = useState("");
  const text = line ?? shellLine(command.value, words ?? []);
  const onClick = (): void => {
    copy(text).then(() => say("copied"), () => say("the browser does not allow it: select the text"));
    setTimeout(() => say(""), 2500);
  };
  return (
    <div class="command">
      <code>{text}</code>
      <button type="button" class="small" onClick={onClick} aria-label={`Copy as command: ${text}`}>Copy as command</button>
      <span role="status" class="muted">{said}</span>
    </div>
  );
}
