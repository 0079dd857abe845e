// SPDX-License-Identifier: Apache-2.0
#include "solve/series_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "arm/effect_binding.hpp"
#include "effects/registry.hpp"
#include "plumb/runtime/detail/effects/joint_series.hpp"
#include "program/counted_words.hpp"

namespace plumb::offline {
namespace {

constexpr std::size_t kPeaksNamed = 4;

}  // namespace

std::vector<SeriesNumbers> series_numbers(const format::Model& arm) {
  std::vector<SeriesNumbers> out;
  for (std::size_t e = 0; e < arm.effects.size(); ++e) {
    const format::Effect& effect = arm.effects[e];
    if (!is_series(effect.name)) continue;
    const int count = static_cast<int>(effect.parameters.size() / effect.joints.size());
    const double width = descriptor_of(effect.name).prior_width;
    for (std::size_t i = 0; i < effect.joints.size(); ++i) {
      SeriesNumbers one{static_cast<int>(e), effect.joints[i], static_cast<int>(i) * count, count,
                        Eigen::VectorXd(count)};
      for (int k = 0; k < count; ++k)
        one.sigma(k) = width * effect_parameter(arm, static_cast<int>(e), one.first + k).typical;
      out.push_back(std::move(one));
    }
  }
  return out;
}

bool is_amplitude_of_series(const format::Model& arm, const Parameter& parameter) {
  return parameter.of_effect() &&
         is_series(arm.effects[static_cast<std::size_t>(parameter.joint)].name);
}

std::vector<SeriesPeak> series_peaks(const format::Model& arm) {
  std::vector<SeriesPeak> out;
  for (const auto& one : series_numbers(arm)) {
    const double* at = arm.effects[static_cast<std::size_t>(one.effect)].parameters.data();
    for (int k = 0; k < one.count / 2; ++k)
      out.push_back(
          {one.joint, k + 1, std::hypot(at[one.first + 2 * k], at[one.first + 2 * k + 1])});
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const SeriesPeak& a, const SeriesPeak& b) { return a.size > b.size; });
  return out;
}

std::string series_words(const Cell& cell, const format::Model& arm) {
  auto peaks = series_peaks(arm);
  if (peaks.empty()) return {};
  peaks.resize(std::min(peaks.size(), kPeaksNamed));
  std::string out;
  int joint = -1;
  for (const auto& peak : peaks) {
    if (out.empty())
      out = fmt::format("largest {:.0f} µrad at {} a turn", peak.size * 1e6,
                        counted_words(peak.k, "cycle", "cycles"));
    else
      out += fmt::format(", {:.0f} at {}", peak.size * 1e6, peak.k);
    const auto index = static_cast<std::size_t>(peak.joint);
    if (peak.joint != joint) out += " of " + cell.nominal.joints[index].name;
    joint = peak.joint;
    const auto& ratio = cell.mechanics[index].gear_ratio;
    for (const double turns : {0.5, 1.0, 2.0})
      if (ratio && std::abs(peak.k - turns * std::abs(*ratio)) < 0.5)
        out += fmt::format(" ({:g} a motor turn)", turns);
  }
  return out;
}

Eigen::MatrixXd series_waves(const Eigen::Ref<const Eigen::VectorXd>& q, int count) {
  Eigen::MatrixXd out(q.size(), count);
  std::array<double, 2 * format::kMaxSeriesWaves> at;
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    effects::JointSeries::slopes(portable::sin_cos(q(i)),
                                 std::span(at).first(static_cast<std::size_t>(count)));
    for (int k = 0; k < count; ++k) out(i, k) = at[static_cast<std::size_t>(k)];
  }
  return out;
}

}  // namespace plumb::offline
