// SPDX-License-Identifier: Apache-2.0
import type { ComponentChildren } from "preact";

export function Card({ title, children, class: more = "", lead }: { title: string; children: ComponentChildren; class?: string; lead?: ComponentChildren }) {
  return (
    <section class={`card ${more}`}>
      <h2>{title}</h2>
      {lead && <p class="lead">{lead}</p>}
      {children}
    </section>
  );
}

/** A wide table scrolls by itself, by keyboard too. */
export function Scroll({ children, label }: { children: ComponentChildren; label: string }) {
  return <div class="scroll" role="region" aria-label={label} tabIndex={0}>{children}</div>;
}
