// SPDX-License-Identifier: Apache-2.0
import { Card } from "../parts/card";
import { Command } from "../parts/command";
import { Figure } from "../parts/figure";
import { runNumber, runRow } from "../store";

/** The curve of each formula in the model of this run, as the joints' curves show the effects of the library. */
export function Formulas() {
  if (!runRow.value?.effects?.some((effect) => effect.startsWith("formula"))) return null;
  return (
    <Card title="Your formulas in this model" class="wide">
      <Figure name="formulas" />
      <Command words={["plot", "formulas", "--run", String(runNumber.value)]} />
    </Card>
  );
}
