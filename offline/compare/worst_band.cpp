// SPDX-License-Identifier: Apache-2.0
#include "compare/worst_band.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "arm/predicted_points.hpp"
#include "compare/pose_words.hpp"

namespace plumb::offline::compare {
namespace {

constexpr int kSteps = 8;                 // of the range of a joint
constexpr std::size_t kFewestInBand = 4;  // poses, for a mean and its standard error
constexpr double kStandardErrors = 4.0;   // 1 % shared among the 72 steps of nine joints

struct Sums {
  double n = 0.0, sum = 0.0, squares = 0.0;
  void add(double v) { n += 1.0, sum += v, squares += v * v; }
  double mean() const { return n > 0.0 ? sum / n : 0.0; }
  double variance() const {
    return n > 1.0 ? std::max(0.0, squares - n * mean() * mean()) / (n - 1.0) : 0.0;
  }
};

std::string range_text(const Cell& cell, const WorstBand& band) {
  const format::JointRow& row = cell.nominal.joints[static_cast<std::size_t>(band.joint)];
  const bool slides = row.type == format::JointType::kPrismatic;
  const double per = slides ? 1e3 : 180.0 / std::numbers::pi;
  return fmt::format("{} between {:.0f} and {:.0f} {}", row.name, std::round(band.from * per) + 0.0,
                     std::round(band.to * per) + 0.0, slides ? "mm" : "deg");
}

/// The length of the error of each row [m].
Eigen::VectorXd error_sizes(const Measurements& measured, const Fit& fit) {
  return residuals(measured, fit.predicted_M).rowwise().norm();
}

std::optional<WorstBand> band_of(const Cell& cell, const Measurements& measured,
                                 const std::vector<int>& rows, const Eigen::VectorXd& error_m) {
  std::optional<WorstBand> best;
  double most = kStandardErrors;
  Sums all;
  for (const int row : rows) all.add(error_m(row));
  for (int j = 0; j < cell.joints(); ++j) {
    double low = INFINITY, high = -INFINITY;
    for (const int row : rows) {
      low = std::min(low, measured.q(row, j));
      high = std::max(high, measured.q(row, j));
    }
    if (!(high > low)) continue;
    const double step = (high - low) / kSteps;
    const auto step_of = [&](int row) {
      return std::min(kSteps - 1, static_cast<int>((measured.q(row, j) - low) / step));
    };
    std::vector<Sums> sums(kSteps);
    for (const int row : rows) sums[static_cast<std::size_t>(step_of(row))].add(error_m(row));
    for (int k = 0; k < kSteps; ++k) {
      const Sums& in = sums[static_cast<std::size_t>(k)];
      const Sums out{all.n - in.n, all.sum - in.sum, all.squares - in.squares};
      if (in.n < kFewestInBand || out.n < kFewestInBand) continue;
      const double spread = std::sqrt(in.variance() / in.n + out.variance() / out.n);
      const double times = (in.mean() - out.mean()) / std::max(spread, 1e-15);
      if (times <= most) continue;
      most = times;
      best = WorstBand{j, low + k * step, low + (k + 1) * step, in.mean(), out.mean(), {}};
      for (const int row : rows)
        if (step_of(row) == k) best->rows.push_back(row);
    }
  }
  if (best)
    std::stable_sort(best->rows.begin(), best->rows.end(),
                     [&](int a, int b) { return error_m(a) > error_m(b); });
  return best;
}

}  // namespace

std::optional<WorstBand> worst_band(const Cell& cell, const Measurements& measured,
                                    const Fit& fit) {
  return band_of(cell, measured, judged_rows(fit), error_sizes(measured, fit));
}

std::string where_sentence(const Cell& cell, const Measurements& measured, const Fit& fit) {
  std::vector<int> rows = judged_rows(fit);
  const Eigen::VectorXd error_m = error_sizes(measured, fit);
  if (rows.empty()) return "There is no pose to judge.";
  std::stable_sort(rows.begin(), rows.end(), [&](int a, int b) { return error_m(a) > error_m(b); });
  if (rows.size() == 1)
    return fmt::format("There is one pose only: it misses by {}.",
                       length_text(error_m(rows.front())));
  if (const auto band = band_of(cell, measured, rows, error_m))
    return fmt::format("The error is largest at {}: {} on average, {} elsewhere; worst at {}.",
                       range_text(cell, *band), length_text(band->mean_m),
                       length_text(band->elsewhere_m), pose_list(measured, band->rows, 3));
  return fmt::format("No range of a joint stands out; the worst of {} are {}, up to {}.",
                     judged_words(fit), pose_names(measured, rows, 3),
                     length_text(error_m(rows.front())));
}

}  // namespace plumb::offline::compare
