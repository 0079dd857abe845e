// SPDX-License-Identifier: Apache-2.0
import type { ComponentChildren } from "preact";
import { useState } from "preact/hooks";
import { command } from "../store";
import type { Blocks as All } from "../types";
import { Scroll } from "./card";
import { Command } from "./command";
import { Figure } from "./figure";

type Block = All[number];

function Table({ of }: { of: Block }) {
  const rows = of.rows ?? [], head = of.head ?? [];
  if (rows.length === 0) return null;
  return (
    <section class="card wide">
      <h2>{of.caption}</h2>
      <Scroll label={of.caption ?? ""}>
        <table>
          <thead><tr>{head.map((word) => <th scope="col">{word}</th>)}</tr></thead>
          <tbody>{rows.map(([first, ...others]) => (
            <tr><th scope="row">{first}</th>{others.map((cell) => <td class="text">{cell}</td>)}</tr>
          ))}</tbody>
        </table>
      </Scroll>
    </section>
  );
}

/** A figure that is drawn only when it is asked for, since that takes a while. */
function Folded({ name }: { name: string }) {
  const [open, setOpen] = useState(false);
  return (
    <details onToggle={(event) => { if (event.currentTarget.open) setOpen(true); }}>
      <summary>Figure: {name}</summary>
      {open && <Figure name={name} />}
    </details>
  );
}

/** A result as the command shows it, block by block; tables that the page shows in another way are replaced by name. */
export function Blocks({ of, instead = {} }: { of: All; instead?: Record<string, ComponentChildren> }) {
  return (
    <div class="blocks">
      {of.map((block) => {
        if (block.kind === "sentence") return <p class={`sentence ${block.class ?? ""}`}>{block.words}</p>;
        if (block.kind === "note") return <p class="muted">{block.words}</p>;
        if (block.kind === "table") return block.name && block.name in instead ? instead[block.name] : <Table of={block} />;
        if (block.kind === "figure") return <Folded name={block.name ?? ""} />;
        return <div class="next"><span>Next{block.why && `, ${block.why}`}:</span> <Command line={(block.command ?? "").replace(/^plumb/, command.value)} /></div>;
      })}
    </div>
  );
}
