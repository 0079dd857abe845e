// SPDX-License-Identifier: Apache-2.0
import { signal } from "@preact/signals";
import { goTo, kScreens } from "./hash";
import { step } from "./store";

export const helpIsOpen = signal(false);
export const showHelp = (): void => { helpIsOpen.value = true; };

export const kKeys: [string, string][] = [
  ["1 to 7", "the screens, in the order of the work"],
  ["j, k", "next and previous pose, worst first"],
  ["a", "add the first effect that the evidence supports (Learn), or the formula that was checked (Improve)"],
  ["u", "undo: drop the effect that was added last"],
  ["?", "this help"],
  ["Tab, Enter, Space, arrow keys", "as in every page; in the 3-D view arrow keys turn it, + and - zoom"],
];

const isWriting = (target: EventTarget | null): boolean =>
  target instanceof HTMLElement && (target.isContentEditable || ["INPUT", "TEXTAREA", "SELECT"].includes(target.tagName));

/** Presses the button of this id if it can be pressed now. */
function press(id: string): void {
  const button = document.getElementById(id);
  if (button instanceof HTMLButtonElement && !button.disabled) button.click();
}

/** Asked of the page itself: a signal would hear of a closed dialog one key too late. */
const dialogIsOpen = (): boolean => document.querySelector("dialog[open]") !== null;

export function listenToKeys(undo: () => void): void {
  window.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || isWriting(event.target) || dialogIsOpen()) return;
    const number = Number(event.key);
    if (number >= 1 && number <= kScreens.length) goTo(kScreens[number - 1]);
    else if (event.key === "j") step(1);
    else if (event.key === "k") step(-1);
    else if (event.key === "a") press("add-first");
    else if (event.key === "u") undo();
    else if (event.key === "?") showHelp();
    else return;
    event.preventDefault();
  });
}
