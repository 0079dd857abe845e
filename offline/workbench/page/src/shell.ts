// SPDX-License-Identifier: Apache-2.0
/** A word as a POSIX shell reads it back. */
export const shellWord = (word: string): string =>
  /^[A-Za-z0-9_.,:=@%+\/-]+$/.test(word) ? word : `'${word.replace(/'/g, `'\\''`)}'`;

export const shellLine = (start: string, words: string[]): string => [start, ...words.map(shellWord)].join(" ");
