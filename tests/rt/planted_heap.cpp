// SPDX-License-Identifier: Apache-2.0
// A violation that the symbol gate must catch.
int* planted_heap(int n) { return new int(n); }
