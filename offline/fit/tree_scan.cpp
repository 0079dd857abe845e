// SPDX-License-Identifier: Apache-2.0
#include "fit/tree_scan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "fit/tree_regression.hpp"

namespace plumb::offline {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();
constexpr double kTie = 1e-12;  // of the RSS: less is rounding, not a better split
constexpr double kRankLimit = kMinIndependentShare * kMinIndependentShare;

/// Two regressions side by side: one from each end of a sorted list.
using Pair = double __attribute__((vector_size(16)));

template <int P, class Scalar>
Scalar least_independent(const Regression<P, Scalar>& regression) {
  Scalar least = regression.independent(0);
  for (int i = 1; i < P; ++i) {
    const Scalar& d = regression.independent(i);
    least = d < least ? d : least;
  }
  return least;
}

/// RSS of the first 1, 2, ... rows of a sorted list and of its last ones; infinite where the rows
/// do not support a leaf.
struct EndSums {
  std::vector<double> low, high;
};

template <int P>
void sum_from_both_ends(const TrainingRows& rows, std::span<const int> order, int min_samples,
                        EndSums& out) {
  const int n = static_cast<int>(order.size());
  out.low.assign(n + 1, kNone);
  out.high.assign(n + 1, kNone);
  Regression<P, Pair> regression;
  std::array<Pair, P + 1> x;
  for (int count = 1; count <= n - min_samples; ++count) {
    const double* low = &rows.values[order[count - 1] * (P + 1)];
    const double* high = &rows.values[order[n - count] * (P + 1)];
    for (int k = 0; k <= P; ++k) x[k] = Pair{low[k], high[k]};
    regression.add(x);
    if (count < min_samples) continue;
    const Pair least = least_independent(regression);
    if (least[0] >= kRankLimit * count) out.low[count] = regression.rss()[0];
    if (least[1] >= kRankLimit * count) out.high[count] = regression.rss()[1];
  }
}

double midway(double a, double b) {
  const double middle = a + (b - a) / 2.0;
  return middle < b ? middle : a;
}

template <int P>
SplitCandidate search(const TrainingRows& rows, const std::vector<std::span<const int>>& sorted,
                      int min_samples) {
  SplitCandidate best{.rss = kNone};
  EndSums sums;
  for (int column = 0; column < P; ++column) {
    const auto order = sorted[column];
    const int n = static_cast<int>(order.size());
    sum_from_both_ends<P>(rows, order, min_samples, sums);
    for (int low = min_samples; low <= n - min_samples; ++low) {
      const double rss = sums.low[low] + sums.high[n - low];
      if (!(rss < best.rss * (1.0 - kTie))) continue;
      const double a = rows.value(order[low - 1], column), b = rows.value(order[low], column);
      if (b - a > kSameValue) best = {column, midway(a, b), rss};
    }
  }
  return best;
}

template <int P>
int first_dependent(const TrainingRows& rows) {
  Regression<P, double> regression;
  std::array<double, P + 1> x;
  for (int row = 0; row < rows.rows; ++row) {
    std::copy_n(&rows.values[row * (P + 1)], P + 1, x.begin());
    regression.add(x);
  }
  for (int i = 0; i < P; ++i)
    if (regression.independent(i) < kRankLimit * regression.count()) return i;
  return -1;
}

template <int P>
LocalModel fit_rows_of(const TrainingRows& rows, std::span<const int> which) {
  LocalModel out;
  Regression<P, double> regression;
  std::array<double, P + 1> x;
  out.y_min = kNone;
  out.y_max = -kNone;
  for (int row : which) {
    std::copy_n(&rows.values[row * (P + 1)], P + 1, x.begin());
    out.y_min = std::min(out.y_min, x[P]);
    out.y_max = std::max(out.y_max, x[P]);
    regression.add(x);
  }
  out.samples = regression.count();
  out.rss = regression.rss();
  const auto w = regression.coefficients();
  out.w[0] = w[0];
  for (int i = 0; i < P; ++i) out.w[rows.inputs[i] + 1] = w[i + 1];
  return out;
}

/// Calls f with the number of inputs as a compile-time constant.
template <int P = 1, class F>
auto with_inputs(int inputs, const F& f) {
  using Constant = std::integral_constant<int, P>;
  if constexpr (P < format::kMaxJoints)
    return inputs == P ? f(Constant{}) : with_inputs<P + 1>(inputs, f);
  else
    return f(Constant{});
}

}  // namespace

SplitCandidate best_split(const TrainingRows& rows, const std::vector<std::span<const int>>& sorted,
                          int min_samples) {
  return with_inputs(rows.stride - 1,
                     [&](auto p) { return search<p()>(rows, sorted, min_samples); });
}

LocalModel fit_cell_model(const TrainingRows& rows, std::span<const int> which) {
  return with_inputs(rows.stride - 1, [&](auto p) { return fit_rows_of<p()>(rows, which); });
}

int dependent_input(const TrainingRows& rows) {
  return with_inputs(rows.stride - 1, [&](auto p) { return first_dependent<p()>(rows); });
}

}  // namespace plumb::offline
