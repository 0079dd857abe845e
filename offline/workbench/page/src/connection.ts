// SPDX-License-Identifier: Apache-2.0
import { signal } from "@preact/signals";

/** Whether the server answers. */
export const connection = signal<"starting" | "there" | "lost">("starting");
