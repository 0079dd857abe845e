// SPDX-License-Identifier: Apache-2.0
// News of the server: a new state of the cell, progress of jobs. Connects again with growing pauses.
import { token } from "./api";
import { connection } from "./connection";

export interface News { type: string; [key: string]: unknown }

const kFirstPause = 500, kLongestPause = 8000; // [ms]
const kSilence = 25000;                        // [ms] without a ping: the connection is dead

let pause = kFirstPause;

export function listen(onNews: (news: News) => void, onConnected: () => void): void {
  const scheme = location.protocol === "https:" ? "wss" : "ws";
  const socket = new WebSocket(`${scheme}://${location.host}/api/ws?token=${encodeURIComponent(token())}`);
  let silence = 0;
  const heard = (): void => {
    clearTimeout(silence);
    silence = window.setTimeout(() => socket.close(), kSilence);
  };
  let opened = false;
  socket.onopen = () => {
    opened = true;
    pause = kFirstPause;
    connection.value = "there";
    heard();
    onConnected();
  };
  socket.onmessage = (event) => {
    heard();
    try {
      onNews(JSON.parse(String(event.data)) as News);
    } catch {
      // a frame that is no JSON says nothing
    }
  };
  socket.onclose = () => {
    clearTimeout(silence);
    connection.value = "lost";
    // Refused although a server answers: it was started again, with another token.
    if (!opened)
      fetch("/api/runs", { cache: "no-store" }).then((answer) => {
        if (!answer.ok) return;
        connection.value = "other";
        onConnected();
      }, () => undefined);
    window.setTimeout(() => listen(onNews, onConnected), pause);
    pause = Math.min(2 * pause, kLongestPause);
  };
}
