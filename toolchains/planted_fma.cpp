// SPDX-License-Identifier: Apache-2.0
// A violation that the gate must catch: compiled with contraction, for a CPU that has the
// instruction.
double planted_fma(double a, double b, double c) { return a * b + c; }
