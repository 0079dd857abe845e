// SPDX-License-Identifier: Apache-2.0
import { task } from "../jobs";
import { Action } from "../parts/action";
import { Card } from "../parts/card";
import { NeedsRun } from "../parts/empty";
import { Scroll } from "../parts/card";
import { namesOf, useFigures } from "../see/see";
import { runNumber } from "../store";

const kFile = "report.html";

function FigureFiles() {
  const run = runNumber.value;
  const list = namesOf(useFigures(run)).filter(({ name }) => name !== "evidence");
  return (
    <Card title="Figures one by one" lead={<>Each is one SVG file: <code>plumb plot NAME -o NAME.svg</code></>}>
      <Scroll label="Figures">
        <table>
          <tbody>{list.map(({ name, shows }) => (
            <tr><th scope="row"><a href={`/fig/${encodeURIComponent(name)}.svg?run=${run}&width=1000`} download={`${name}.svg`}>{name}</a></th><td class="text">{shows}</td></tr>
          ))}</tbody>
        </table>
      </Scroll>
    </Card>
  );
}

export function ReportScreen() {
  const { job, busy, problem } = task("report").value;
  const made = job?.state === "done" && !busy && !problem;
  const address = `/api/files/${kFile}?job=${job?.job ?? 0}`;
  return (
    <NeedsRun>
      <Card title="The report" lead="One file for the customer: it opens from disk, needs no network, and prints to A4.">
        <Action purpose="report" verb="report" args={["-o", kFile, "--force"]} main>Write the report</Action>
        {made && <p role="status">Written. <a href={address} target="_blank" rel="noopener">Open {kFile}</a> or <a href={address} download={kFile}>save it</a>.</p>}
      </Card>
      {made && <iframe title="The report" src={address} class="report" />}
      <FigureFiles />
    </NeedsRun>
  );
}
