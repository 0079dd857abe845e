// SPDX-License-Identifier: Apache-2.0
// Requests to the server that sent the page. The token of the address is kept for this tab and taken
// out of what the browser shows.
import { connection } from "./connection";
import type { Problem } from "./types";

const kTokenKey = "plumb-token";

export function takeToken(): void {
  const url = new URL(location.href);
  const token = url.searchParams.get("token");
  if (token === null) return;
  sessionStorage.setItem(kTokenKey, token);
  url.searchParams.delete("token");
  history.replaceState(null, "", url.pathname + url.search + url.hash);
}

export const token = (): string => sessionStorage.getItem(kTokenKey) ?? "";

/** An answer that is an error: carries the problem as the server words it. */
export class ApiError extends Error {
  constructor(readonly status: number, readonly problem: Problem) {
    super(problem.message);
  }
}

export function problemOf(error: unknown): Problem {
  if (error instanceof ApiError) return error.problem;
  return { code: "", message: error instanceof Error ? error.message : String(error) };
}

async function refused(answer: Response): Promise<ApiError> {
  try {
    const body = (await answer.json()) as { error?: Problem };
    if (body.error?.message) return new ApiError(answer.status, body.error);
  } catch {
    // no JSON: said by the status below
  }
  return new ApiError(answer.status, { code: "", message: `The server answered ${answer.status} ${answer.statusText}.` });
}

async function ask(path: string, how: RequestInit = {}): Promise<Response> {
  let answer: Response;
  try {
    answer = await fetch(path, { ...how, cache: "no-store" });
  } catch (error) {
    if (error instanceof DOMException && error.name === "AbortError") throw error;
    connection.value = "lost";
    throw new ApiError(0, { code: "", message: "The server does not answer.", help: "plumb serve" });
  }
  if (!answer.ok) throw await refused(answer);
  return answer;
}

export async function getJson<T>(path: string, signal?: AbortSignal): Promise<T> {
  return (await (await ask(path, { signal })).json()) as T;
}

export async function getText(path: string, signal?: AbortSignal): Promise<string> {
  return (await ask(path, { signal })).text();
}

async function write<T>(method: string, path: string, body?: BodyInit): Promise<T> {
  const headers: Record<string, string> = { "X-Plumb-Token": token() };
  if (typeof body === "string") headers["Content-Type"] = "application/json";
  const answer = await ask(path, { method, headers, body });
  const text = await answer.text();
  return (text === "" ? {} : JSON.parse(text)) as T;
}

export const postJson = <T>(path: string, body: unknown): Promise<T> => write<T>("POST", path, JSON.stringify(body));
export const putFile = (name: string, file: Blob, force: boolean): Promise<unknown> =>
  write("PUT", `/api/files/${encodeURIComponent(name)}${force ? "?force=1" : ""}`, file);
export const remove = (path: string): Promise<unknown> => write("DELETE", path);
