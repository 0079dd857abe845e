// SPDX-License-Identifier: Apache-2.0
#include "diagnose/refused_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "diagnose/constants.hpp"
#include "diagnose/found.hpp"

namespace plumb::offline {
namespace {

/// One figure of an error of points and orientations [m]: the latter in their noise floors.
double counted_m(const Diagnosis& d, const HeldOutError& error, double ErrorStats::*figure) {
  const double points_m = error.points.*figure;
  if (!d.turns || !(d.floor.mean_m > 0.0) || !(d.turns->floor.mean_rad > 0.0)) return points_m;
  return std::hypot(points_m, error.turns.*figure * d.floor.mean_m / d.turns->floor.mean_rad);
}

}  // namespace

std::size_t steps_kept(double before, const std::vector<double>& errors) {
  // The error may rise for a while, until later effects bring it down again.
  if (errors.empty() ||
      errors.back() <=
          std::min(before, kMostRise * *std::min_element(errors.begin(), errors.end())))
    return errors.size();
  double least = before;
  std::size_t kept = 0, seen = 0;
  while (seen < errors.size() && errors[seen] <= kLeap * least) {
    if (errors[seen] < least) {
      least = errors[seen];
      kept = seen + 1;
    }
    ++seen;
  }
  const bool sound = seen == errors.size() && errors.back() <= kMostRise * least;
  return sound ? errors.size() : kept;
}

std::size_t steps_kept(const Diagnosis& d) {
  std::vector<double> errors;
  for (std::size_t i = 1; i <= d.added.size(); ++i)
    errors.push_back(counted_m(d, error_after(d, i), &ErrorStats::mean));
  return steps_kept(counted_m(d, error_after(d, 0), &ErrorStats::mean), errors);
}

bool rises_over(const Diagnosis& d, const HeldOutError& after) {
  const HeldOutError before = error_after(d, 0);
  const auto rises = [&](double ErrorStats::*figure) {
    return counted_m(d, after, figure) > counted_m(d, before, figure);
  };
  return rises(&ErrorStats::mean) || rises(&ErrorStats::rms);
}

HeldOutError error_after(const Diagnosis& d, std::size_t steps) {
  if (steps > 0) return {d.added[steps - 1].held, d.added[steps - 1].turns};
  return {d.before, d.turns ? d.turns->before : ErrorStats{}};
}

Problem refusal(const Cell& cell, const Diagnosis& d, std::size_t kept,
                const HeldOutError& rose_to) {
  std::vector<std::string> names;
  for (std::size_t i = kept; i < d.added.size(); ++i)
    names.push_back(key_of(cell, d.added[i].entry));
  const HeldOutError least = error_after(d, kept);
  std::string rise = fmt::format(" rose from {:.3f} to {:.3f} mm", least.points.mean * 1e3,
                                 rose_to.points.mean * 1e3);
  if (d.turns)
    rise = fmt::format(", points and orientations together,{} and from {} to {}", rise,
                       angle_words(least.turns.mean), angle_words(rose_to.turns.mean));
  return {
      .severity = Severity::kWarning,
      .code = "W-DIAGNOSE-ROSE",
      .message = fmt::format("not added, though the fitted readings speak for it: {}; the error "
                             "on unseen poses{}",
                             fmt::join(names, ", "), rise),
      .help = "plumb explain W-DIAGNOSE-ROSE"};
}

}  // namespace plumb::offline
