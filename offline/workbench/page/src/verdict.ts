// SPDX-License-Identifier: Apache-2.0
import { computed } from "@preact/signals";
import { poses, runDetail, runNumber } from "./store";

export interface Verdict { word: string; sentence: string; kind: "good" | "partly" | "bad" | "none" }

/** The words in front of the colon of the verdict, and their colour. */
export const verdict = computed<Verdict>(() => {
  const sentence = poses.value?.verdict_sentence ?? runDetail.value?.verdict ?? "";
  if (sentence === "") return { word: runNumber.value === null ? "No run yet" : "Loading", sentence, kind: "none" };
  const [head] = sentence.split(/[:,.]/);
  if (/^No pose was held out/.test(head)) return { word: "Accuracy unknown", sentence, kind: "partly" };
  if (/^Not good everywhere/.test(head)) return { word: head, sentence, kind: "partly" };
  if (/^Not/.test(head)) return { word: head, sentence, kind: "bad" };
  if (/^Good only/.test(head)) return { word: "Good in part", sentence, kind: "partly" };
  if (/^Good/.test(head)) return { word: /still missing|differ|too large/.test(sentence) ? "Good, not complete" : "Good", sentence, kind: /still missing|differ|too large/.test(sentence) ? "partly" : "good" };
  return { word: head.length < 40 ? head : "See the verdict", sentence, kind: "partly" };
});
