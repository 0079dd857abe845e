// SPDX-License-Identifier: Apache-2.0
import { useEffect, useRef, useState } from "preact/hooks";
import { mm, plain } from "../numbers";
import { Scroll } from "../parts/card";
import { brushed, joints, pick, picked, poses, worstFirst } from "../store";
import type { Poses } from "../types";

const kFew = 12, kMany = 200;
export const kSetWords = { fit: "fit", held: "held out", out: "left out" } as const;

export function WorstPoses() {
  const [most, setMost] = useState(kFew);
  const all = poses.value, inside = brushed.value, at = picked.value;
  const body = useRef<HTMLTableSectionElement>(null);
  const order = worstFirst.value.filter((i) => inside === null || inside.has(i));
  const place = order.indexOf(at);
  const first = place < most ? 0 : Math.max(0, place - Math.floor(most / 2));
  useEffect(() => {
    const row = body.current?.querySelector(".picked"), box = row?.closest(".scroll");
    if (!row || !box) return;
    const [a, b] = [row.getBoundingClientRect(), box.getBoundingClientRect()];
    if (a.bottom > b.bottom) box.scrollTop += a.bottom - b.bottom;
    if (a.top < b.top + 30) box.scrollTop -= b.top + 30 - a.top;
  }, [at]);
  if (!all) return null;
  return (
    <>
      <Scroll label="Worst poses">
        <table>
          <thead><tr><th scope="col">Pose</th><th scope="col">Set</th><th scope="col">Before [mm]</th><th scope="col">After [mm]</th><th scope="col">ex [mm]</th><th scope="col">ey [mm]</th><th scope="col">ez [mm]</th></tr></thead>
          <tbody ref={body}>
            {order.slice(first, first + most).map((i) => (
              <tr key={all.row[i]} class={i === at ? "picked" : ""} onClick={() => pick(i)}>
                <th scope="row"><button type="button" class="link" aria-pressed={i === at} onClick={() => pick(i)}>{all.pose[i]}</button></th>
                <td>{kSetWords[all.set[i]]}</td>
                <td class="n">{mm(all.before_norm_mm[i])}</td>
                <td class="n">{mm(all.after_norm_mm[i])}</td>
                {all.after_mm.map((column) => <td class="n">{mm(column[i])}</td>)}
              </tr>
            ))}
          </tbody>
        </table>
      </Scroll>
      {order.length > kFew && (
        <button type="button" class="small" onClick={() => setMost(most === kFew ? kMany : kFew)}>
          {most === kFew ? `Show ${Math.min(kMany, order.length)} of ${order.length}` : "Show fewer"}
        </button>
      )}
    </>
  );
}

export function PickedPose({ all }: { all: Poses }) {
  const i = picked.value;
  if (i < 0) return null;
  return (
    <p id="picked" role="status">
      <strong>Pose {all.pose[i]}</strong> (row {all.row[i] + 1}, {kSetWords[all.set[i]]}): {mm(all.before_norm_mm[i])} mm before, {mm(all.after_norm_mm[i])} mm after.{" "}
      <span class="muted">{all.q.map((column, j) => `${joints.value[j]?.name ?? `J${j + 1}`} ${plain(column[i])}`).join(", ")} {[...new Set(all.q_units)].join(", ")}</span>
    </p>
  );
}
