// SPDX-License-Identifier: Apache-2.0
// A violation that the symbol gate must catch.
int planted_exception(int n) {
  if (n < 0) throw n;
  return n;
}
