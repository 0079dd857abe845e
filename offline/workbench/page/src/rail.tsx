// SPDX-License-Identifier: Apache-2.0
import { goTo, kScreenNames, kScreens, screen } from "./hash";
import { showHelp } from "./keys";

export function Rail() {
  return (
    <nav class="rail" aria-label="Screens">
      <p class="brand" aria-hidden="true">Plumb</p>
      <ol>
        {kScreens.map((name, i) => (
          <li>
            <a href={`#${name}`} aria-current={screen.value === name ? "page" : undefined} aria-keyshortcuts={String(i + 1)}
              onClick={(event) => { event.preventDefault(); goTo(name); }}>
              <kbd aria-hidden="true">{i + 1}</kbd> {kScreenNames[name]}
            </a>
          </li>
        ))}
      </ol>
      <button type="button" class="small" aria-keyshortcuts="?" onClick={showHelp}>Keys <kbd aria-hidden="true">?</kbd></button>
    </nav>
  );
}
