// SPDX-License-Identifier: Apache-2.0
import { param } from "../hash";
import { count } from "../numbers";
import { Action, Progress } from "../parts/action";
import { Card } from "../parts/card";
import { Empty } from "../parts/empty";
import { cell } from "../store";
import { CheckCard } from "./check";
import { FileList, files, isText, RawPreview, Upload, useFiles } from "./files";
import { ImportPanel } from "./import";

function Chosen() {
  const name = param("file") ?? cell.value?.data?.files[0]?.name;
  if (name === undefined || !files.value.some((file) => file.name === name)) return null;
  const measured = cell.value?.data?.files.some((file) => file.name === name);
  return (
    <Card title={name} class="wide">
      <RawPreview name={name} />
      {isText(name) && !measured && <ImportPanel name={name} />}
    </Card>
  );
}

export function DataScreen() {
  useFiles();
  const data = cell.value?.data;
  const fitted = cell.value?.current_run !== null;
  return (
    <>
      <Card title="Files" lead={data ? `${count(data.rows, "row")} of ${count(data.poses, "pose")} in ${count(data.files.length, "file")}; ${data.used} rows are used.` : undefined}>
        {!data && <Empty>There are no measurements yet. Drop the file of the tracker here; it needs joint positions and measured points.</Empty>}
        <FileList />
        <Upload />
      </Card>
      {data && (
        <Card title="Fit" lead={fitted ? "There is a run of the present cell and data." : "The present cell and data have no run yet."}>
          <Action purpose="fit" verb="fit" main={!fitted} quiet>{fitted ? "Fit again" : "Fit the arm"}</Action>
          <Progress purpose="fit" />
        </Card>
      )}
      <Chosen />
      {data && <CheckCard />}
    </>
  );
}
