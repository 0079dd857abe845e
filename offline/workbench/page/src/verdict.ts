// SPDX-License-Identifier: Apache-2.0
import { computed } from "@preact/signals";
import { poses, runDetail, runNumber } from "./store";

export interface Verdict { word: string; sentence: string; kind: "good" | "partly" | "bad" | "none" }

/** The verdict as plumb words it, and its colour. */
export const verdict = computed<Verdict>(() => {
  const { verdict: sentence, verdict_head: word, verdict_class: found } = poses.value ?? runDetail.value ?? {};
  if (!sentence || !word || !found) return { word: runNumber.value === null ? "No run yet" : "Loading", sentence: sentence ?? "", kind: "none" };
  return { word, sentence, kind: found === "unknown" ? "partly" : found };
});
