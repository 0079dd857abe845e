// SPDX-License-Identifier: Apache-2.0
#include "figures/worst_band.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "draw/ticks.hpp"
#include "figures/words.hpp"

namespace plumb::offline::figures {
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

std::string range_text(const RunResults& results, const WorstBand& band) {
  const format::JointRow& row = results.cell.nominal.joints[static_cast<std::size_t>(band.joint)];
  const bool slides = row.type == format::JointType::kPrismatic;
  const double per = slides ? 1e3 : 180.0 / std::numbers::pi;
  return fmt::format("{} between {:.0f} and {:.0f} {}", row.name, std::round(band.from * per) + 0.0,
                     std::round(band.to * per) + 0.0, slides ? "mm" : "deg");
}

}  // namespace

std::optional<WorstBand> worst_band(const RunResults& results) {
  const auto rows = usual_rows(results, results.judged());
  std::optional<WorstBand> best;
  double most = kStandardErrors;
  Sums all;
  for (const int row : rows) all.add(results.after(row));
  for (int j = 0; j < results.cell.joints(); ++j) {
    double low = INFINITY, high = -INFINITY;
    for (const int row : rows) {
      low = std::min(low, results.measured.q(row, j));
      high = std::max(high, results.measured.q(row, j));
    }
    if (!(high > low)) continue;
    const double step = (high - low) / kSteps;
    const auto step_of = [&](int row) {
      return std::min(kSteps - 1, static_cast<int>((results.measured.q(row, j) - low) / step));
    };
    std::vector<Sums> sums(kSteps);
    for (const int row : rows) sums[static_cast<std::size_t>(step_of(row))].add(results.after(row));
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
                     [&](int a, int b) { return results.after(a) > results.after(b); });
  return best;
}

std::string where_sentence(const RunResults& results) {
  std::vector<int> rows = usual_rows(results, results.judged());
  if (rows.empty()) return "There is no pose to judge.";
  std::stable_sort(rows.begin(), rows.end(),
                   [&](int a, int b) { return results.after(a) > results.after(b); });
  if (rows.size() == 1)
    return fmt::format("There is one pose only: it misses by {}.",
                       length_text(results.after(rows.front())));
  if (const auto band = worst_band(results))
    return fmt::format("The error is largest at {}: {} on average, {} elsewhere; worst at {}.",
                       range_text(results, *band), length_text(band->mean_m),
                       length_text(band->elsewhere_m), pose_list(results, band->rows, 3));
  return fmt::format("No range of a joint stands out; the worst of {} are {}, up to {}.",
                     judged_words(results), pose_names(results, rows, 3),
                     length_text(results.after(rows.front())));
}

}  // namespace plumb::offline::figures
