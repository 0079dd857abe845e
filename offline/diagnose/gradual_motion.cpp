// SPDX-License-Identifier: Apache-2.0
#include "diagnose/gradual_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "diagnose/constants.hpp"
#include "effects/effect_option.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {
namespace {

constexpr std::array kLengths = {0.05, 0.1, 0.2, 0.4, 0.8};  // of a ramp, as shares of the series
constexpr std::array kDecays = {0.05, 0.1, 0.2};  // time constants, as shares of the series

/// Place of every pose in the series, from 0 to 1.
Eigen::ArrayXd places_of(const WhitenedFit& s) {
  Eigen::ArrayXd out(s.poses());
  for (Eigen::Index i = 0; i < s.poses(); ++i) out(i) = s.context[i].order;
  return (out - out.minCoeff()) / std::max(1.0, out.maxCoeff() - out.minCoeff());
}

struct Shape {
  std::string words;
  Eigen::ArrayXd value;  // (poses,)
};

Shape ramp(const Eigen::ArrayXd& at, double from, double to) {
  return {fmt::format("moves gradually, from {:.0f} to {:.0f} % of the series",
                      100.0 * std::max(0.0, from), 100.0 * std::min(1.0, to)),
          ((at - from) / (to - from)).max(0.0).min(1.0)};
}

Shape decay(const Eigen::ArrayXd& at, double from, double length) {
  return {fmt::format("jumps at {:.0f} % of the series and moves back", 100.0 * from),
          (at >= from).select((-(at - from) / length).exp(), Eigen::ArrayXd::Zero(at.size()))};
}

std::vector<Shape> shapes_around(const Eigen::ArrayXd& at, double first, double last) {
  const double between = last - first, middle = 0.5 * (first + last);
  std::vector<Shape> out;
  for (const double length : kLengths) {
    if (length < between) continue;
    out.push_back(ramp(at, middle - 0.5 * length, middle + 0.5 * length));
    out.push_back(ramp(at, first - length, first));
    out.push_back(ramp(at, last, last + length));
  }
  for (const double length : kDecays) out.push_back(decay(at, first, length));
  return out;
}

}  // namespace

std::optional<Found> gradual_motion_instead_of(const WhitenedFit& s, const Found& step) {
  if (!is_change_point(step.entry.name)) return std::nullopt;
  const Eigen::ArrayXd at = places_of(s);
  const auto place_of = [&](double row) {
    double low = 1.0;
    for (Eigen::Index i = 0; i < s.poses(); ++i)
      if (s.context[i].order >= row) low = std::min(low, at(i));
    return low;
  };
  const double first = place_of(number_option(step.entry, OptionKey::kAfterRow, 0.0));
  const double last = step.moves.empty() ? first : place_of(step.moves.back().after_row);
  const Scorer scorer(s);
  std::optional<Found> best;
  for (Shape& shape : shapes_around(at, first, last)) {
    const Regressor regressor = pattern_of_part(
        s, step.entry, {{}, std::move(shape.words), {"order"}, 0.0, true}, shape.value);
    RegressorScore scored = scorer.score(regressor);
    if (best && best->ln_bayes() >= scored.evidence.ln_bayes) continue;
    best = Found{regressor.entry, regressor.pattern, std::move(scored), {}, 0.0, {}, 0.0};
  }
  if (!best || best->ln_bayes() < step.ln_bayes() + kSupported) return std::nullopt;
  return best;
}

}  // namespace plumb::offline
