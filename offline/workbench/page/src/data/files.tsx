// SPDX-License-Identifier: Apache-2.0
import { signal } from "@preact/signals";
import { useEffect, useState } from "preact/hooks";
import { ApiError, getJson, getText, problemOf, putFile } from "../api";
import { param, setParams } from "../hash";
import { bytes, count } from "../numbers";
import { Scroll } from "../parts/card";
import { ProblemBox } from "../parts/problem";
import { cell, state } from "../store";
import type { CellFile, Problem } from "../types";

export const files = signal<CellFile[]>([]);

export function useFiles(): void {
  const version = state.value;
  useEffect(() => {
    const loading = new AbortController();
    getJson<CellFile[] | { files: CellFile[] }>("/api/files", loading.signal)
      .then((answer) => { files.value = Array.isArray(answer) ? answer : answer.files; })
      .catch(() => undefined);
    return () => loading.abort();
  }, [version]);
}

export const isText = (name: string): boolean => /\.(csv|txt|tsv|dat)$/i.test(name);


export function Upload() {
  const [over, setOver] = useState(false);
  const [said, say] = useState("");
  const [problem, setProblem] = useState<Problem | null>(null);
  const [again, setAgain] = useState<File | null>(null);
  const put = async (file: File, force: boolean): Promise<void> => {
    setProblem(null);
    setAgain(null);
    if (file.size === 0) return setProblem({ code: "", message: `${file.name} is empty.` });
    try {
      await putFile(file.name, file, force);
      say(`${file.name} is in the cell (${bytes(file.size)}).`);
      files.value = (await getJson<CellFile[]>("/api/files"));
      setParams({ file: file.name });
    } catch (error) {
      setProblem(problemOf(error));
      if (error instanceof ApiError && error.status === 409) setAgain(file);
    }
  };
  const all = (list: FileList | null | undefined): void => { for (const file of list ?? []) void put(file, false); };
  return (
    <div class={`drop ${over ? "over" : ""}`}
      onDragOver={(event) => { event.preventDefault(); setOver(true); }} onDragLeave={() => setOver(false)}
      onDrop={(event) => { event.preventDefault(); setOver(false); all(event.dataTransfer?.files); }}>
      <label>Drop a file of measurements here, or choose one <input type="file" multiple accept=".csv,.txt,.toml" onChange={(event) => all(event.currentTarget.files)} /></label>
      <p class="muted">Text of a tracker or a controller: csv or txt. It is copied into the cell folder; nothing leaves this computer.</p>
      {said && <p role="status">{said}</p>}
      {problem && <ProblemBox problem={problem}>{again && <button type="button" onClick={() => void put(again, true)}>Replace {again.name}</button>}</ProblemBox>}
    </div>
  );
}

export function FileList() {
  const used = new Map((cell.value?.data?.files ?? []).map(({ name, rows }) => [name, rows]));
  const chosen = param("file");
  return (
    <Scroll label="Files of the cell">
      <table>
        <thead><tr><th scope="col">File</th><th scope="col">Size</th><th scope="col">Changed</th><th scope="col">Used as</th></tr></thead>
        <tbody>
          {files.value.map(({ name, bytes: size, changed }) => (
            <tr key={name} class={name === chosen ? "picked" : ""}>
              <th scope="row"><button type="button" class="link" aria-pressed={name === chosen} onClick={() => setParams({ file: name })}>{name}</button></th>
              <td class="n">{bytes(size)}</td>
              <td>{changed.replace("T", " ").slice(0, 16)}</td>
              <td>{used.has(name) ? `measurements, ${count(used.get(name) ?? 0, "row")}` : name === "cell.toml" ? "description of the cell" : ""}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </Scroll>
  );
}

const kRows = 8, kColumns = 40;

/** The beginning of a file as it stands on the disk. */
export function RawPreview({ name, line }: { name: string; line?: number }) {
  const [text, setText] = useState("");
  const [problem, setProblem] = useState<Problem | null>(null);
  const version = state.value;
  useEffect(() => {
    const loading = new AbortController();
    getText(`/api/files/${encodeURIComponent(name)}`, loading.signal)
      .then((all) => { setText(all); setProblem(null); })
      .catch((error: unknown) => { if (!loading.signal.aborted) setProblem(problemOf(error)); });
    return () => loading.abort();
  }, [name, version]);
  if (problem) return <ProblemBox problem={problem} />;
  const all = text.split(/\r?\n/);
  const lines = line === undefined && name.endsWith(".csv") ? all.filter((row) => !row.startsWith("#")) : all;
  if (line !== undefined) return <pre class="row-of-file">{`${line}: ${lines[line - 1] ?? ""}`.slice(0, 400)}</pre>;
  if (!name.endsWith(".csv")) return <Scroll label={`Text of ${name}`}><pre>{text.slice(0, 20000)}</pre></Scroll>;
  const separator = [";", "\t", ","].find((s) => lines[0]?.includes(s)) ?? ",";
  const rows = lines.filter((row) => row !== "").length - 1;
  const cut = (row: string): string[] => row.split(separator).slice(0, kColumns);
  return (
    <Scroll label={`First rows of ${name}`}>
      <table>
        <thead><tr>{cut(lines[0] ?? "").map((head) => <th scope="col">{head}</th>)}</tr></thead>
        <tbody>{lines.slice(1, 1 + kRows).filter((row) => row !== "").map((row) => <tr>{cut(row).map((value) => <td>{value}</td>)}</tr>)}</tbody>
      </table>
      <p class="muted">The first {Math.min(kRows, rows)} of {rows} rows, as they stand in the file; units stand in the names of the columns.</p>
    </Scroll>
  );
}

