// SPDX-License-Identifier: Apache-2.0
import { useEffect, useRef } from "preact/hooks";
import { helpIsOpen, kKeys } from "./keys";

export function Help() {
  const dialog = useRef<HTMLDialogElement>(null);
  const open = helpIsOpen.value;
  useEffect(() => {
    if (open && !dialog.current?.open) dialog.current?.showModal();
    if (!open) dialog.current?.close();
  }, [open]);
  return (
    <dialog ref={dialog} aria-labelledby="help-title" onClose={() => { helpIsOpen.value = false; }}>
      <h2 id="help-title">Keys</h2>
      <dl class="keys">{kKeys.map(([keys, words]) => <div><dt><kbd>{keys}</kbd></dt><dd>{words}</dd></div>)}</dl>
      <p>Every button shows the command that does the same in a shell. The page and a shell may work on one cell at once.</p>
      <form method="dialog"><button>Close</button></form>
    </dialog>
  );
}
