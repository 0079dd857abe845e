// SPDX-License-Identifier: Apache-2.0
#include "tree/scan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "tree/regression.hpp"

namespace plumb::offline {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();
constexpr double kTie = 1e-12;  // share of the RSS; smaller differences are rounding errors
constexpr double kRankLimit = kMinIndependentShare * kMinIndependentShare;
constexpr int kFixedTerms = 9;  // loops over at most so many terms are unrolled

/// Two regressions that are computed together, one from each end of a sorted list.
using Pair = double __attribute__((vector_size(16)));

template <class Scalar, class Regressed>
Scalar least_independent(const Regressed& regression) {
  Scalar least = regression.independent(0);
  for (int i = 1; i < regression.terms(); ++i) {
    const Scalar& d = regression.independent(i);
    least = d < least ? d : least;
  }
  return least;
}

/// The RSS of the first 1, 2, ... rows of a sorted list, and of the last ones. It is infinite where
/// the rows are not sufficient for a leaf.
struct EndSums {
  std::vector<double> low, high;
};

template <int P, int Y>
void sum_from_both_ends(const TrainingRows& rows, std::span<const int> order, int min_samples,
                        EndSums& out) {
  const int n = static_cast<int>(order.size()), stride = rows.stride;
  out.low.assign(n + 1, kNone);
  out.high.assign(n + 1, kNone);
  Regression<P, Y, Pair> regression(rows.term_count());
  typename Regression<P, Y, Pair>::Row x;
  for (int count = 1; count <= n - min_samples; ++count) {
    const double* low = &rows.values[order[count - 1] * stride];
    const double* high = &rows.values[order[n - count] * stride];
    const int columns = regression.terms() + Y;
    for (int k = 0; k < columns; ++k) x[k] = Pair{low[k], high[k]};
    regression.add(x);
    if (count < min_samples) continue;
    const Pair least = least_independent<Pair>(regression);
    if (least[0] >= kRankLimit * count) out.low[count] = regression.rss()[0];
    if (least[1] >= kRankLimit * count) out.high[count] = regression.rss()[1];
  }
}

double midway(double a, double b) {
  const double middle = a + (b - a) / 2.0;
  return middle < b ? middle : a;
}

/// Searches the best split along one order of the rows; value(i) is the value of its i-th row.
/// Returns true if the split is better than `best`, which it then replaces.
template <int P, int Y, class Value>
bool search(const TrainingRows& rows, std::span<const int> order, const Value& value,
            const Admissible& admissible, int min_samples, EndSums& sums, SplitCandidate& best) {
  const int n = static_cast<int>(order.size());
  sum_from_both_ends<P, Y>(rows, order, min_samples, sums);
  bool better = false;
  for (int low = min_samples; low <= n - min_samples; ++low) {
    const double rss = sums.low[low] + sums.high[n - low];
    if (!(rss < best.rss * (1.0 - kTie))) continue;
    const double a = value(low - 1), b = value(low);
    if (b - a <= kSameValue) continue;
    const double threshold = std::clamp(midway(a, b), admissible.from, admissible.to);
    if (threshold < a || threshold >= b) continue;
    best.threshold = threshold;
    best.rss = rss;
    better = true;
  }
  return better;
}

template <int P, int Y>
int first_dependent(const TrainingRows& rows) {
  Regression<P, Y, double> regression(rows.term_count());
  typename Regression<P, Y, double>::Row x;
  for (int row = 0; row < rows.rows; ++row) {
    std::copy_n(&rows.values[row * rows.stride], rows.stride, x.begin());
    regression.add(x);
  }
  for (int i = 0; i < regression.terms(); ++i)
    if (regression.independent(i) < kRankLimit * regression.count()) return i;
  return -1;
}

template <int P, int Y>
LocalModel fit_rows_of(const TrainingRows& rows, std::span<const int> which, int all_terms) {
  LocalModel out;
  Regression<P, Y, double> regression(rows.term_count());
  typename Regression<P, Y, double>::Row x;
  const int first = rows.term_count();
  out.y_min.fill(kNone);
  out.y_max.fill(-kNone);
  for (int row : which) {
    std::copy_n(&rows.values[row * rows.stride], rows.stride, x.begin());
    for (int k = 0; k < Y; ++k) {
      out.y_min[k] = std::min(out.y_min[k], x[first + k]);
      out.y_max[k] = std::max(out.y_max[k], x[first + k]);
    }
    regression.add(x);
  }
  out.samples = regression.count();
  out.rss = regression.rss();
  out.w.assign(static_cast<std::size_t>(rows.outputs) * all_terms, 0.0);
  for (int k = 0; k < rows.outputs; ++k) {
    const auto w = regression.coefficients(k);
    out.w[k * all_terms] = w[0];
    for (int i = 0; i < first; ++i) out.w[k * all_terms + rows.terms[i]] = w[i + 1];
  }
  return out;
}

/// Calls f with the numbers of terms and outputs as compile-time constants.
template <int P = 1, class F>
auto with_sizes(const TrainingRows& rows, const F& f) {
  using One = std::integral_constant<int, 1>;
  using All = std::integral_constant<int, format::kTreeAxes>;
  const auto with_terms = [&](auto p) { return rows.outputs == 1 ? f(p, One{}) : f(p, All{}); };
  if constexpr (P <= kFixedTerms)
    return rows.term_count() == P ? with_terms(std::integral_constant<int, P>{})
                                  : with_sizes<P + 1>(rows, f);
  else
    return with_terms(std::integral_constant<int, kAnyTerms>{});
}

}  // namespace

SplitCandidate best_split(const TrainingRows& rows, const std::vector<std::span<const int>>& sorted,
                          std::span<const Admissible> admissible, int min_samples) {
  return with_sizes(rows, [&](auto p, auto y) {
    SplitCandidate best;
    best.rss = kNone;
    EndSums sums;
    for (int column = 0; column < rows.inputs; ++column) {
      const auto order = sorted[column];
      const auto value = [&](int i) { return rows.value(order[i], column); };
      if (search<p(), y()>(rows, order, value, admissible[column], min_samples, sums, best))
        best.column = column;
    }
    return best;
  });
}

LocalModel fit_cell_model(const TrainingRows& rows, std::span<const int> which, int all_terms) {
  return with_sizes(rows,
                    [&](auto p, auto y) { return fit_rows_of<p(), y()>(rows, which, all_terms); });
}

int dependent_term(const TrainingRows& rows) {
  return with_sizes(rows, [&](auto p, auto y) { return first_dependent<p(), y()>(rows); });
}

}  // namespace plumb::offline
