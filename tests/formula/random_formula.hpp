// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tests/random_numbers.hpp"

namespace plumb::tests {

/// What a random formula reads: q1 … q6, dir1 … dir6 and the parameters a b c d.
struct FormulaInput {
  double q[6], dir[6], p[4];
};

inline int between(Random& random, int low, int high) { return low + random.below(high - low + 1); }

/// A random formula as text with as few parentheses as the rules of precedence allow, and as a
/// function of <cmath> alone: evidence that shares nothing with the code under test.
struct RandomFormula {
  std::string text;
  int binding;  // of its outermost sign: 1 sum, 2 product, 3 sign, 4 power, 5 a word
  std::function<double(const FormulaInput&)> value;

  std::string within(int least) const { return binding < least ? "(" + text + ")" : text; }
};

inline RandomFormula random_leaf(Random& random) {
  const int j = between(random, 0, 5), k = between(random, 0, 3);
  switch (between(random, 0, 4)) {
    case 0:
      return {"q" + std::to_string(j + 1), 5, [j](const auto& in) { return in.q[j]; }};
    case 1:
      return {"dir" + std::to_string(j + 1), 5, [j](const auto& in) { return in.dir[j]; }};
    case 2: {
      const int tenths = between(random, 1, 40);
      return {std::to_string(tenths) + "e-1", 5, [tenths](const auto&) { return tenths / 10.0; }};
    }
    default:
      return {std::string(1, static_cast<char>('a' + k)), 5,
              [k](const auto& in) { return in.p[k]; }};
  }
}

inline RandomFormula random_formula(Random& random, int depth) {
  if (depth == 0) return random_leaf(random);
  const auto next = [&] { return random_formula(random, between(random, 0, depth - 1)); };
  const auto call1 = [](const char* name, const RandomFormula& a, double (*f)(double)) {
    return RandomFormula{std::string(name) + "(" + a.text + ")", 5,
                         [f, v = a.value](const auto& in) { return f(v(in)); }};
  };
  const RandomFormula a = next(), b = next();
  const auto x = a.value, y = b.value;
  switch (between(random, 0, 17)) {
    case 0:
    case 1:
      return {a.within(1) + " + " + b.within(2), 1,
              [x, y](const auto& in) { return x(in) + y(in); }};
    case 2:
    case 3:
      return {a.within(1) + " - " + b.within(2), 1,
              [x, y](const auto& in) { return x(in) - y(in); }};
    case 4:
    case 5:
      return {a.within(2) + "*" + b.within(3), 2, [x, y](const auto& in) { return x(in) * y(in); }};
    case 6:
      return {a.within(2) + "/" + b.within(3), 2, [x, y](const auto& in) { return x(in) / y(in); }};
    case 7:
      return {"-" + a.within(3), 3, [x](const auto& in) { return -x(in); }};
    case 8: {
      const int n = between(random, -3, 3);
      return {a.within(5) + "^" + std::to_string(n), 4,
              [x, n](const auto& in) { return std::pow(x(in), n); }};
    }
    case 9: {
      // A tower: a^b^c is a^(b^c).
      const RandomFormula base = call1("abs", a, [](double v) { return std::fabs(v); });
      return {base.within(5) + "^" + b.within(3), 4,
              [v = base.value, y](const auto& in) { return std::pow(v(in), y(in)); }};
    }
    case 10:
      return call1("sin", a, [](double v) { return std::sin(v); });
    case 11:
      return call1("cos", a, [](double v) { return std::cos(v); });
    case 12:
      return call1("exp", call1("tanh", a, [](double v) { return std::tanh(v); }),
                   [](double v) { return std::exp(v); });
    case 13:
      return call1("log", call1("abs", a, [](double v) { return std::fabs(v); }),
                   [](double v) { return std::log(v); });
    case 14:
      return call1("sqrt", call1("abs", a, [](double v) { return std::fabs(v); }),
                   [](double v) { return std::sqrt(v); });
    case 15:
      return {"max(" + a.text + ", min(" + b.text + ", 1))", 5,
              [x, y](const auto& in) { return std::fmax(x(in), std::fmin(y(in), 1.0)); }};
    case 16:
      return {"clamp(" + a.text + ", -2, 2)", 5, [x](const auto& in) {
                const double v = x(in);
                return v < -2.0 ? -2.0 : v > 2.0 ? 2.0 : v;
              }};
    default:
      return {"(sign(" + a.text + ") + step(" + b.text + "))", 5, [x, y](const auto& in) {
                const double s = x(in);
                return (s > 0.0 ? 1.0 : s < 0.0 ? -1.0 : 0.0) + (y(in) > 0.0 ? 1.0 : 0.0);
              }};
  }
}

}  // namespace plumb::tests
