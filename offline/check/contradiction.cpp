// SPDX-License-Identifier: Apache-2.0
#include "check/contradiction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "arm/predicted_points.hpp"
#include "cell/random.hpp"
#include "cell/table_place.hpp"
#include "check/constants.hpp"
#include "check/regularised_fit.hpp"
#include "check/row_lines.hpp"
#include "numbers/quantile.hpp"
#include "solve/thinned_rows.hpp"

namespace plumb::offline {
namespace {

/// Lines that a message names.
constexpr std::size_t kListed = 5;
/// Rounds in which the rows that agree are found and fitted: they change little after the first.
constexpr int kPolishRounds = 3;

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const auto n = static_cast<double>(a.size());
  const double ma = std::accumulate(a.begin(), a.end(), 0.0) / n;
  const double mb = std::accumulate(b.begin(), b.end(), 0.0) / n;
  double aa = 0.0, bb = 0.0, ab = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    aa += (a[i] - ma) * (a[i] - ma);
    bb += (b[i] - mb) * (b[i] - mb);
    ab += (a[i] - ma) * (b[i] - mb);
  }
  return aa > 0.0 && bb > 0.0 ? ab / std::sqrt(aa * bb) : 0.0;
}

/// The arm that fits the majority of the rows: least trimmed squares by concentration steps.
class Majority {
 public:
  Majority(const Cell& cell, const MeasurementFiles& measured, const std::vector<int>& rows)
      : cell_(cell), measured_(measured), rows_(rows), some_(pick(measured, rows)) {}

  /// Starts at the common fit and, if that leaves gross errors, at fits of random rows as well.
  void find(const ArmState& placed) {
    state_ = placed;
    const bool gross = middle_error(placed) > check::kGross_m;
    concentrate(placed);
    if (gross) random_starts(placed);
    polish();
  }

  std::vector<double> errors() const { return errors_of(state_); }
  double scatter() const { return scatter_; }

 private:
  std::vector<double> errors_of(const ArmState& state) const {
    const Eigen::VectorXd e = residuals(some_, predict_points(state, some_)).rowwise().norm();
    return {e.data(), e.data() + e.size()};
  }
  double middle_error(const ArmState& state) const { return median(errors_of(state)); }

  std::size_t kept() const {
    return static_cast<std::size_t>(check::kTrimmed * static_cast<double>(rows_.size()));
  }

  /// The kept rows with the least errors, in order.
  std::vector<int> nearest(const ArmState& state) const {
    const auto e = errors_of(state);
    std::vector<std::size_t> order(e.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(kept()),
                     order.end(), [&](std::size_t a, std::size_t b) { return e[a] < e[b]; });
    order.resize(kept());
    std::sort(order.begin(), order.end());
    std::vector<int> out;
    for (const std::size_t k : order) out.push_back(rows_[k]);
    return out;
  }

  double trimmed_error(const ArmState& state) const {
    auto e = errors_of(state);
    std::sort(e.begin(), e.end());
    return std::accumulate(e.begin(), e.begin() + static_cast<std::ptrdiff_t>(kept()), 0.0);
  }

  void concentrate(const ArmState& start) {
    ArmState state = start;
    std::vector<int> before;
    for (int step = 0; step < check::kConcentrationSteps; ++step) {
      const auto now = nearest(state);
      if (now == before) break;
      before = now;
      state = regularised_fit(cell_, measured_, now,
                              robust_placement(cell_, measured_, now, state).state)
                  .state;
    }
    if (trimmed_error(state) < trimmed_error(state_)) state_ = state;
  }

  void random_starts(const ArmState& placed) {
    Random random(1);
    ArmState best = placed;
    double least = 1e300;
    for (int k = 0; k < check::kRandomStarts; ++k) {
      std::vector<int> few = rows_;
      for (int i = 0; i < check::kOfRandomStart; ++i)
        std::iter_swap(few.begin() + i,
                       few.begin() + i + random.below(static_cast<int>(few.size()) - i));
      few.resize(check::kOfRandomStart);
      ArmState state = robust_placement(cell_, measured_, few, placed).state;
      state = robust_placement(cell_, measured_, nearest(state), state).state;
      if (const double e = trimmed_error(state); e < least) {
        least = e;
        best = state;
      }
    }
    concentrate(best);
  }

  /// Fits all rows that agree, and estimates the scatter from them.
  void polish() {
    for (int round = 0; round < kPolishRounds; ++round) {
      const auto e = errors();
      scatter_ = std::max(median(e), 1e-9);
      std::vector<int> in;
      for (std::size_t k = 0; k < e.size(); ++k)
        if (e[k] <= check::kInside * scatter_) in.push_back(rows_[k]);
      const RegularisedFit fit = regularised_fit(cell_, measured_, in, state_);
      state_ = fit.state;
    }
    double squares = 0.0, count = 0.0;
    for (const double e : errors())
      if (e <= check::kInside * scatter_) {
        squares += e * e;
        count += 1.0;
      }
    scatter_ = count > 0.0 ? std::sqrt(squares / count) : 1e300;
  }

  const Cell& cell_;
  const MeasurementFiles& measured_;
  std::vector<int> rows_;
  Measurements some_;
  ArmState state_;
  double scatter_ = 0.0;
};

/// The rows that contradict the majority.
struct ContradictingRows {
  std::vector<bool> is_outside;  // of every row
  std::vector<int> rows;
  std::vector<double> sizes;
  double between = 0.0;
  int runs = 0;
};

ContradictingRows contradicting_rows(const std::vector<int>& rows,
                                     const std::vector<double>& errors, double scatter) {
  ContradictingRows out;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const bool outside = errors[k] > check::kOutside * scatter;
    out.between += errors[k] > check::kInside * scatter && !outside ? 1.0 : 0.0;
    if (outside) {
      out.runs += k == 0 || !out.is_outside.back() ? 1 : 0;
      out.rows.push_back(rows[k]);
      out.sizes.push_back(errors[k]);
    }
    out.is_outside.push_back(outside);
  }
  return out;
}

bool is_point(const std::string& name) {
  return name == "x" || name == "y" || name == "z" || name == "repeat";
}

/// True if a column of the file separates these rows from the others, and so may name their cause.
bool follows_a_column(const MeasurementFiles& measured, const std::vector<int>& rows,
                      const ContradictingRows& part) {
  if (measured.tables.empty()) return false;
  std::vector<double> marks;
  for (const bool outside : part.is_outside) marks.push_back(outside ? 1.0 : 0.0);
  for (const auto& column : measured.tables.front().columns) {
    if (column.values.empty() || is_point(column.name)) continue;
    std::vector<double> values;
    for (const int row : rows) {
      const RowPlace at = row_place(measured, row);
      const Column* here = measured.tables[static_cast<std::size_t>(at.table)].find(column.name);
      if (here == nullptr || here->values.empty()) break;
      values.push_back(here->values[static_cast<std::size_t>(at.row)]);
    }
    if (values.size() == rows.size() && std::abs(correlation(values, marks)) > check::kPartFollows)
      return true;
  }
  return false;
}

std::string lines_of(const MeasurementFiles& measured, const std::vector<int>& rows) {
  if (measured.tables.empty()) return "";
  std::vector<int> lines;
  for (std::size_t k = 0; k < std::min(kListed, rows.size()); ++k) {
    const RowPlace at = row_place(measured, rows[k]);
    lines.push_back(measured.tables[static_cast<std::size_t>(at.table)]
                        .lines[static_cast<std::size_t>(at.row)]);
  }
  return fmt::format(", lines {}{}", fmt::join(lines, ", "), rows.size() > kListed ? ", ..." : "");
}

std::optional<Place> place_of(const MeasurementFiles& measured, int row) {
  if (measured.tables.empty()) return std::nullopt;
  const RowPlace at = row_place(measured, row);
  const Table& table = measured.tables[static_cast<std::size_t>(at.table)];
  const Column* column = table.find(measured.has_axis[0] ? "x" : "y");
  if (column == nullptr) return std::nullopt;
  return place_in_row(table, at.row, *column, "the first of these");
}

double rms_error(const Measurements& some, const ArmState& state) {
  return std::sqrt(residuals(some, predict_points(state, some)).squaredNorm() /
                   static_cast<double>(some.size()));
}

}  // namespace

std::optional<Problem> contradiction(const Cell& cell, const MeasurementFiles& measured,
                                     const std::vector<int>& rows, const ArmState& placed) {
  if (static_cast<int>(rows.size()) < check::kFewestRows || !measured.setup.empty())
    return std::nullopt;
  const std::vector<int> some = thinned(measured, rows, check::kContradictionRows);
  if (rms_error(pick(measured, some), placed) < check::kGood_m) return std::nullopt;
  Majority majority(cell, measured, some);
  majority.find(placed);
  const ContradictingRows part = contradicting_rows(some, majority.errors(), majority.scatter());
  const auto all = static_cast<double>(some.size());
  const double share = static_cast<double>(part.rows.size()) / all;
  if (share < check::kLeastPart || share > check::kMostPart ||
      part.between > check::kBetween * all || part.runs < check::kFewestRuns)
    return std::nullopt;
  const double usual = median(part.sizes);
  if (usual < std::max(check::kPartError_m, check::kPartClear * majority.scatter()) ||
      follows_a_column(measured, some, part))
    return std::nullopt;
  return Problem{
      Severity::kWarning, "W-CHECK-CONTRADICT",
      fmt::format("{:.0f} % of the readings contradict the others{}: these fit one arm to {:.2g} "
                  "mm RMS, the former miss it by {:.3g} mm (median)",
                  100.0 * share, lines_of(measured, part.rows), majority.scatter() * 1e3,
                  usual * 1e3),
      place_of(measured, part.rows.front()),
      "find what is different about these rows: another tool, another station, or the side from "
      "which the joints came (dir_jN columns: import --dir from-order); if nothing is, measure "
      "them again or mark them with set = ignore"};
}

}  // namespace plumb::offline
