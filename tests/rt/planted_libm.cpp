// SPDX-License-Identifier: Apache-2.0
// A violation that the symbol gate must catch.
#include <cmath>
double planted_libm(double x) { return std::sin(x); }
