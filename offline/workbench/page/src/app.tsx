// SPDX-License-Identifier: Apache-2.0
import "plumb-colours.css";
import "uplot/dist/uPlot.min.css";
import "./app.css";
import { render } from "preact";
import type { FunctionComponent } from "preact";
import { takeToken } from "./api";
import { followAddress, kScreenNames, screen, type Screen } from "./hash";
import { ConnectionNote, Header } from "./header";
import { Help } from "./help";
import { listenToKeys } from "./keys";
import { ProblemBox } from "./parts/problem";
import { Rail } from "./rail";
import { cell, cellProblem, start } from "./store";
import { DataScreen } from "./data/data";
import { SeeScreen } from "./see/see";
import { LearnScreen } from "./learn/learn";
import { ImproveScreen } from "./improve/improve";
import { undoLast } from "./improve/undo";
import { ShipScreen } from "./ship/ship";
import { MonitorScreen } from "./monitor/monitor";
import { ReportScreen } from "./report/report";

const kParts: Record<Screen, FunctionComponent> = {
  data: DataScreen, see: SeeScreen, learn: LearnScreen, improve: ImproveScreen, ship: ShipScreen,
  monitor: MonitorScreen, report: ReportScreen,
};

function App() {
  const Part = kParts[screen.value];
  return (
    <>
      <a class="skip" href="#screen" onClick={(event) => { event.preventDefault(); document.getElementById("screen")?.focus(); }}>To the content</a>
      <Header />
      <Rail />
      <main id="screen" tabIndex={-1}>
        <h1>{kScreenNames[screen.value]}</h1>
        <ConnectionNote />
        {cellProblem.value && <ProblemBox problem={cellProblem.value} />}
        {cell.value ? <Part key={screen.value} /> : !cellProblem.value && <p role="status">Reading the cell …</p>}
      </main>
      <Help />
    </>
  );
}

takeToken();
followAddress();
listenToKeys(undoLast);
start();
const root = document.getElementById("app");
if (root) {
  root.replaceChildren();
  render(<App />, root);
}
