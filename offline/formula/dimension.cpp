// SPDX-License-Identifier: Apache-2.0
#include "formula/dimension.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <vector>

namespace plumb::offline {
namespace {

constexpr double kSame = 1e-9;

Dimension sum(const Dimension& a, const Dimension& b, double times) {
  Dimension out = a;
  for (std::size_t i = 0; i < out.power.size(); ++i) out.power[i] += times * b.power[i];
  return out;
}

std::string factor(const char* unit, double power) {
  return std::abs(power - 1.0) < kSame ? unit : fmt::format("{}^{:g}", unit, power);
}

}  // namespace

bool Dimension::operator==(const Dimension& other) const {
  for (std::size_t i = 0; i < power.size(); ++i)
    if (std::abs(power[i] - other.power[i]) > kSame) return false;
  return true;
}

Dimension operator*(const Dimension& a, const Dimension& b) { return sum(a, b, 1.0); }
Dimension operator/(const Dimension& a, const Dimension& b) { return sum(a, b, -1.0); }
Dimension raised(const Dimension& a, double power) { return sum({}, a, power); }

std::string text_of(const Dimension& dimension) {
  // A unit with s^-2, or a higher power of 1/s, for each kg is written with forces.
  const double kg = dimension.power[1];
  const bool forces = std::abs(kg) > kSame && -dimension.power[2] / kg > 2.0 - kSame;
  const Dimension rest = forces ? dimension / raised(kForce, kg) : dimension;
  const std::pair<const char*, double> parts[] = {{"N", forces ? kg : 0.0},
                                                  {"kg", rest.power[1]},
                                                  {"m", rest.power[0]},
                                                  {"s", rest.power[2]},
                                                  {"K", rest.power[3]}};
  std::vector<std::string> above, below;
  for (const auto& [unit, power] : parts) {
    if (std::abs(power) < kSame) continue;
    (power > 0.0 ? above : below).push_back(factor(unit, std::abs(power)));
  }
  std::string over = above.empty() ? "1" : fmt::format("{}", fmt::join(above, " "));
  if (below.empty()) return over;
  const std::string under = fmt::format("{}", fmt::join(below, " "));
  return over + (below.size() > 1 ? "/(" + under + ")" : "/" + under);
}

}  // namespace plumb::offline
