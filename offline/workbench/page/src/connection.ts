// SPDX-License-Identifier: Apache-2.0
import { signal } from "@preact/signals";

/** Whether the server answers; "other": one answers that does not know our token, so that it only shows. */
export const connection = signal<"starting" | "there" | "lost" | "other">("starting");
