// SPDX-License-Identifier: Apache-2.0
#include "check/row_faults.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "arm/parameter.hpp"
#include "arm/predicted_points.hpp"
#include "check/constants.hpp"
#include "check/faulty_run.hpp"
#include "check/regularised_fit.hpp"
#include "check/row_lines.hpp"
#include "fit/calibrate.hpp"
#include "numbers/quantile.hpp"
#include "solve/thinned_rows.hpp"

namespace plumb::offline {
namespace {

/// Error of a row that a shift takes beyond the file.
constexpr double kNoPartner_m = 1e3;
constexpr double kDegrees = 180.0 / M_PI;  // in a radian

/// The rows of one file.
class RowFaults {
 public:
  RowFaults(const Cell& cell, const Measurements& of_file, const std::string& point_unit,
            const std::string& turn_unit)
      : cell_(cell), now_(of_file) {
    for (int j = 0; j < cell.joints(); ++j)
      faults_.push_back({.kind = RowFault::Kind::kSign, .joint = j});
    for (const int shift : {-1, 1, -2, 2})
      faults_.push_back({.kind = RowFault::Kind::kShift, .shift = shift});
    for (const auto& [unit, metres] : kLengths)
      for (const auto& [says, labelled] : kLengths)
        if (says == point_unit && unit != says)
          faults_.push_back({.kind = RowFault::Kind::kPointUnit,
                             .factor = metres / labelled,
                             .is = unit,
                             .says = says});
    const bool degrees = turn_unit == "deg";
    faults_.push_back({.kind = RowFault::Kind::kTurnUnit,
                       .factor = degrees ? kDegrees : 1.0 / kDegrees,
                       .is = degrees ? "rad" : "deg",
                       .says = turn_unit});
  }

  std::vector<FaultyRun> find(double left_m) {
    std::vector<FaultyRun> out;
    const auto arm = arm_of_a_part();
    if (!arm) {
      if (auto all = shifted_file(left_m)) out.push_back(*all);
      return out;
    }
    while (static_cast<int>(out.size()) < check::kMostFaults) {
      const auto run = surest(*arm);
      if (!run) break;
      now_ = repaired(run->fault, run->first, run->last);
      out.push_back(*run);
    }
    return out;
  }

 private:
  static constexpr std::array<std::pair<const char*, double>, 5> kLengths{
      {{"um", 1e-6}, {"mm", 1e-3}, {"cm", 1e-2}, {"in", 25.4e-3}, {"m", 1.0}}};

  int size() const { return now_.size(); }

  /// An arm near nominal that fits these rows of `some`, or nothing.
  std::optional<RegularisedFit> arm_of(const Measurements& some,
                                       const std::vector<int>& rows) const {
    if (rows.size() < check::kFewestFitted) return std::nullopt;
    const auto thin = thinned(some, rows, check::kMostFitted);
    RegularisedFit out =
        regularised_fit(cell_, some, thin, placed_from_the_labels(cell_, some, thin).state);
    if (out.rms_m > check::kSoundShare * reach(cell_.nominal)) return std::nullopt;
    return out;
  }

  /// An arm near nominal that fits a half, a third or a quarter of the file.
  std::optional<ArmState> arm_of_a_part() const {
    constexpr std::array<std::pair<double, double>, 7> kParts{{{0.0, 1.0 / 2},
                                                               {1.0 / 2, 1.0},
                                                               {0.0, 1.0 / 3},
                                                               {1.0 / 3, 2.0 / 3},
                                                               {2.0 / 3, 1.0},
                                                               {0.0, 1.0 / 4},
                                                               {3.0 / 4, 1.0}}};
    for (const auto& [from, to] : kParts) {
      std::vector<int> rows;
      for (int i = static_cast<int>(from * size()); i < static_cast<int>(to * size()); ++i)
        rows.push_back(i);
      if (const auto fit = arm_of(now_, rows)) return fit->state;
    }
    return std::nullopt;
  }

  /// The rows first ... last as they would be without that fault; rows without a partner stay.
  Measurements repaired(const RowFault& fault, int first, int last) const {
    Measurements out = now_;
    for (int i = first; i <= last; ++i) {
      if (fault.kind == RowFault::Kind::kSign) out.q(i, fault.joint) *= -1.0;
      if (fault.kind == RowFault::Kind::kPointUnit) out.p_M.row(i) *= fault.factor;
      if (fault.kind == RowFault::Kind::kShift && has_partner(fault, i))
        out.q.row(i) = now_.q.row(i + fault.shift);
      for (int j = 0; fault.kind == RowFault::Kind::kTurnUnit && j < cell_.joints(); ++j)
        if (cell_.nominal.joints[static_cast<std::size_t>(j)].type == format::JointType::kRevolute)
          out.q(i, j) *= fault.factor;
    }
    return out;
  }

  bool has_partner(const RowFault& fault, int row) const {
    return row + fault.shift >= 0 && row + fault.shift < size();
  }

  static std::vector<double> errors_of(const ArmState& arm, const Measurements& some) {
    const Eigen::VectorXd e = residuals(some, predict_points(arm, some.q)).rowwise().norm();
    return {e.data(), e.data() + e.size()};
  }

  std::vector<double> errors_without(const ArmState& arm, const RowFault& fault) const {
    auto out = errors_of(arm, repaired(fault, 0, size() - 1));
    for (int i = 0; i < size(); ++i)
      if (!has_partner(fault, i)) out[static_cast<std::size_t>(i)] = kNoPartner_m;
    return out;
  }

  /// The run of rows with the largest sum of log likelihood ratios [Kadane].
  static std::pair<FaultyRun, double> likeliest(const RowFault& fault,
                                                const std::vector<double>& as_is,
                                                const std::vector<double>& without,
                                                double scatter) {
    FaultyRun best{.fault = fault};
    double most = 0.0, sum = 0.0;
    int first = 0;
    for (std::size_t i = 0; i < as_is.size(); ++i) {
      sum += std::log(std::hypot(as_is[i], scatter) / std::hypot(without[i], scatter));
      if (sum > most) {
        most = sum;
        best.first = first;
        best.last = static_cast<int>(i);
      }
      if (sum > 0.0) continue;
      sum = 0.0;
      first = static_cast<int>(i) + 1;
    }
    return {best, most};
  }

  std::optional<FaultyRun> surest(const ArmState& arm) const {
    const auto as_is = errors_of(arm, now_);
    // The part that the arm was fitted to may be as small as a quarter of the rows.
    const double scatter = std::max(check::kLeastScatter_m, quantile(as_is, check::kSoundQuantile));
    FaultyRun best;
    double most = 0.0;
    for (const RowFault& fault : faults_) {
      const auto [run, gain] = likeliest(fault, as_is, errors_without(arm, fault), scatter);
      if (gain <= most) continue;
      best = run;
      most = gain;
    }
    if (best.count() < check::kFewestOfRun || best.count() == size()) return std::nullopt;
    return confirmed(best, arm, scatter);
  }

  /// Fits the repaired file again. The run must then fit like the other rows, and no other fault
  /// may explain it.
  std::optional<FaultyRun> confirmed(FaultyRun run, const ArmState& arm, double scatter) const {
    const Measurements better = repaired(run.fault, run.first, run.last);
    const auto first_errors = errors_of(arm, better);
    std::vector<int> near;
    for (int i = 0; i < size(); ++i)
      if (first_errors[static_cast<std::size_t>(i)] <
          check::kElsewhere * scatter + check::kElsewhere_m)
        near.push_back(i);
    const auto fit = arm_of(better, near);
    if (!fit) return std::nullopt;
    const auto after = errors_of(fit->state, better), before = errors_of(fit->state, now_);
    std::vector<double> others;
    for (const int i : near)
      if (i < run.first || i > run.last) others.push_back(after[static_cast<std::size_t>(i)]);
    if (others.size() < check::kFewestFitted) return std::nullopt;
    run.others = std::max(check::kLeastScatter_m, quantile(others, 0.5));
    trim(run, after);
    if (run.count() < check::kFewestOfRun) return std::nullopt;
    run.after = quantile(of(after, run), 0.5);
    run.before = quantile(of(before, run), 0.5);
    const double ordinary = std::max(run.after, run.others);
    if (run.after > check::kLikeOthers * run.others ||
        run.before < check::kTimesBetter * ordinary ||
        quantile(of(after, run), check::kMostOfRun) > check::kMostlyLikeOthers * run.others)
      return std::nullopt;
    for (const RowFault& other : faults_)
      if (!same(other, run.fault) &&
          quantile(of(errors_without(fit->state, other), run), 0.5) < check::kNextBest * ordinary)
        return std::nullopt;
    return run;
  }

  /// Rows at the ends of a run that the repair does not bring near the others have another fault.
  static void trim(FaultyRun& run, const std::vector<double>& after) {
    const auto is_off = [&](int row) {
      return after[static_cast<std::size_t>(row)] > check::kMostlyLikeOthers * run.others;
    };
    while (run.first <= run.last && is_off(run.last)) --run.last;
    while (run.first <= run.last && is_off(run.first)) ++run.first;
  }

  static bool same(const RowFault& a, const RowFault& b) {
    return a.kind == b.kind && a.joint == b.joint && a.shift == b.shift && a.factor == b.factor;
  }

  static std::vector<double> of(const std::vector<double>& errors, const FaultyRun& run) {
    return {errors.begin() + run.first, errors.begin() + run.last + 1};
  }

  /// For a file of which no part fits: all points may belong to the joint positions of other rows.
  std::optional<FaultyRun> shifted_file(double left_m) const {
    std::vector<FaultyRun> found;
    for (const RowFault& fault : faults_) {
      if (fault.kind != RowFault::Kind::kShift) continue;
      FaultyRun run{.fault = fault,
                    .first = std::max(0, -fault.shift),
                    .last = std::min(size(), size() - fault.shift) - 1};
      std::vector<int> rows;
      for (int i = run.first; i <= run.last; ++i) rows.push_back(i);
      const Measurements better = repaired(fault, run.first, run.last);
      const auto fit = arm_of(better, rows);
      if (!fit) continue;
      run.after = run.others =
          std::max(check::kLeastScatter_m, quantile(of(errors_of(fit->state, better), run), 0.5));
      run.before = left_m;
      found.push_back(run);
    }
    std::sort(found.begin(), found.end(),
              [](const FaultyRun& a, const FaultyRun& b) { return a.after < b.after; });
    if (found.empty() || found[0].before < check::kTimesBetter * found[0].after)
      return std::nullopt;
    if (found.size() > 1 && found[1].after < check::kNextBest * found[0].after) return std::nullopt;
    return found[0];
  }

  const Cell& cell_;
  Measurements now_;  // repaired as far as it goes
  std::vector<RowFault> faults_;
};

}  // namespace

std::vector<Problem> row_fault_findings(const Cell& cell, const MeasurementFiles& measured,
                                        const std::vector<int>& rows, const ArmState& placed) {
  std::vector<Problem> out;
  if (!measured.setup.empty() || measured.tables.empty() ||
      std::count(measured.has_axis.begin(), measured.has_axis.end(), true) < 2)
    return out;
  for (std::size_t t = 0; t < measured.tables.size(); ++t) {
    std::vector<int> of_file, places;
    for (const int row : rows)
      if (const RowPlace at = row_place(measured, row);
          at.table == static_cast<int>(t) && of_file.size() < check::kMostOfFile) {
        of_file.push_back(row);
        places.push_back(at.row);
      }
    if (of_file.size() < check::kFewestRows) continue;
    const Measurements some = pick(measured, of_file);
    const Eigen::VectorXd left = residuals(some, predict_points(placed, some)).rowwise().norm();
    if (left.norm() < check::kNothingToExplain_m * std::sqrt(static_cast<double>(left.size())))
      continue;
    const Table& table = measured.tables[t];
    RowFaults faults(cell, some, unit_of_points(table), unit_of_turns(cell, table));
    const double middle = quantile({left.data(), left.data() + left.size()}, 0.5);
    for (const FaultyRun& run : faults.find(middle))
      out.push_back(row_fault_finding(cell, table, places, run));
  }
  return out;
}

}  // namespace plumb::offline
