// SPDX-License-Identifier: Apache-2.0
// How far the true tool point of plumb-twin missed at its stations, which only a simulated robot knows.
import { count, mm, plain } from "../numbers";
import { Card } from "../parts/card";
import { Series } from "./series";

export interface Stops {
  station: number[];
  path_s: (number | null)[];
  correction_mm: (number | null)[];
  true_off_mm: (number | null)[];
  true_on_mm: (number | null)[];
  off_mean_mm: number | null;
  on_mean_mm: number | null;
}

export function TwinCard({ stops, driving }: { stops: Stops; driving: boolean }) {
  const { off_mean_mm: off, on_mean_mm: on } = stops;
  const n = stops.station.length;
  return (
    <Card title="True error of the twin" lead="Distance of the true tool point from where it should be, at every station where the arm has stopped. Only a simulated robot knows it.">
      {n === 0 ? <p role="status">{driving ? "The twin has not stopped at a station yet." : "The twin stopped at no station."}</p> : (
        <>
          <dl class="facts" id="true-error">
            <div><dt>Without correction</dt><dd>{mm(off, 4)} mm</dd></div>
            <div><dt>With it</dt><dd><strong>{mm(on, 4)} mm</strong></dd></div>
            {off !== null && on !== null && on > 0 && <div><dt>Times smaller</dt><dd>{plain(off / on)}</dd></div>}
            <div><dt>Mean of</dt><dd>{count(n, "station")}{driving ? "" : ", the drive has ended"}</dd></div>
          </dl>
          <Series title="True error at the stations [mm]" seconds={stops.path_s.map((t) => t ?? 0)} lines={[
            { label: "without correction", values: stops.true_off_mm, tone: "vermilion", dashed: true },
            { label: "with it", values: stops.true_on_mm, tone: "blue" },
          ]} />
        </>
      )}
    </Card>
  );
}
