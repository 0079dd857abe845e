// SPDX-License-Identifier: Apache-2.0
#include "solve/outliers.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <unordered_set>

#include "arm/predicted_points.hpp"
#include "numbers/quantile.hpp"
#include "solve/constants.hpp"
#include "solve/evaluation.hpp"
#include "solve/leverage.hpp"
#include "solve/many_rows.hpp"
#include "solve/solver.hpp"

namespace plumb::offline {
namespace {

int most_outliers(std::size_t poses) {
  return static_cast<int>(kMostOutlierShare * static_cast<double>(poses));
}

/// Rows that look like outliers, and the other rows.
struct FarRows {
  std::vector<int> rows, rest;
  double share = 0.0;  // of the cost that is due to `rows`
};

/// distance: deletion distances of the rows of `data`, as if each had so many `lines`; plain: their
/// whitened residuals.
FarRows far_from_the_rest(const FitData& data, const Eigen::VectorXd& distance, Eigen::Index lines,
                          const Eigen::VectorXd& plain) {
  const double limit = std::max(kOutlierTimes * usual_scatter(distance, lines),
                                kFarthestFirst * distance.maxCoeff());
  FarRows out;
  double squares = 0.0;
  for (Eigen::Index i = 0; i < distance.size(); ++i) {
    const bool far = distance(i) > limit;
    (far ? out.rows : out.rest).push_back(data.rows[static_cast<std::size_t>(i)]);
    if (far) squares += plain(i) * plain(i);
  }
  out.share = squares / std::max(1e-300, plain.squaredNorm());
  return out;
}

/// Set-ups that would lose more than a third of their poses. The few poses left would determine
/// where tracker and reflector stand, and no other reading could contradict them.
std::set<int> decimated_setups(const FitData& data, const std::vector<int>& all,
                               const std::vector<int>& taken) {
  std::map<int, int> poses, lost;
  for (const int row : all) ++poses[setup_of(*data.measured, row)];
  for (const int row : taken) ++lost[setup_of(*data.measured, row)];
  std::set<int> out;
  for (const auto& [setup, count] : lost)
    if (count > 1 && count > kMostOfSetup * poses[setup]) out.insert(setup);
  return out;
}

/// Adds to `whole` the set-ups that would lose too many poses, and puts all their rows back among
/// the rest. Returns whether rows that had been taken out before came back.
bool keep_setups(const FitData& data, const std::vector<int>& all, std::set<int>& whole,
                 std::vector<int>& taken, FarRows& far) {
  std::vector<int> out = taken;
  out.insert(out.end(), far.rows.begin(), far.rows.end());
  whole.merge(decimated_setups(data, all, out));
  if (whole.empty()) return false;
  const std::size_t before = taken.size();
  const auto stays = [&](int row) { return whole.contains(setup_of(*data.measured, row)); };
  for (auto* rows : {&taken, &far.rows}) {
    std::copy_if(rows->begin(), rows->end(), std::back_inserter(far.rest), stays);
    std::erase_if(*rows, stays);
  }
  std::sort(far.rest.begin(), far.rest.end());
  return taken.size() < before;
}

/// Distances of the rows `taken` from what a fit without them predicts, comparable with those of
/// readings of so many `lines`.
Eigen::VectorXd distances_of(const FitData& data, const std::vector<int>& taken,
                             const Solution& fit, Eigen::Index lines) {
  FitData others = data;
  others.rows = taken;
  return comparable(plain_distances(others, evaluate(others, fit.state, {})), others.line_table(),
                    lines);
}

/// Those rows of `taken` that a fit without them predicts within the limit of an outlier after all.
std::vector<int> agreeing(const FitData& data, const std::vector<int>& taken, const Solution& fit,
                          Eigen::Index lines, double scatter) {
  const Eigen::VectorXd distance = distances_of(data, taken, fit, lines);
  std::vector<int> out;
  for (std::size_t i = 0; i < taken.size(); ++i)
    if (distance(i) <= kOutlierTimes * scatter) out.push_back(taken[i]);
  return out;
}

std::vector<Outlier> described(const FitData& data, const std::vector<int>& taken,
                               const Solution& fit, Eigen::Index lines, double scatter) {
  const Eigen::VectorXd distance = distances_of(data, taken, fit, lines);
  const Measurements some = pick(*data.measured, taken);
  const Rows3 error = residuals(some, predict_points(fit.state, some));
  std::vector<Outlier> out;
  for (std::size_t i = 0; i < taken.size(); ++i)
    out.push_back({.row = taken[i],
                   .error_m = error.row(i).norm(),
                   .times = distance(i) / scatter,
                   .pose = some.pose.empty() ? "" : some.pose[i]});
  std::sort(out.begin(), out.end(),
            [](const Outlier& a, const Outlier& b) { return a.times > b.times; });
  return out;
}

}  // namespace

Eigen::VectorXd deletion_distances(const FitData& data, const Solution& solution) {
  return Leverage(data, solution).distances(data, solution);
}

Eigen::VectorXd deletion_distances(const FitData& data, const Solution& solution,
                                   const std::vector<Parameter>& parameters) {
  return Leverage(data, solution, parameters).distances(data, solution);
}

double usual_scatter(const Eigen::VectorXd& distances, Eigen::Index lines) {
  if (distances.size() == 0) return 1.0;
  const double middle = median({distances.data(), distances.data() + distances.size()});
  return std::max(1.0, middle / kMedianChi[lines]);
}

Eigen::VectorXd comparable(Eigen::VectorXd distances, const LineTable& table, Eigen::Index lines) {
  for (Eigen::Index i = 0; i < distances.size(); ++i)
    distances(i) *= kMedianChi[lines] / kMedianChi[table.count(i)];
  return distances;
}

std::vector<Outlier> solve_without_outliers(FitData& data, const std::vector<Parameter>& parameters,
                                            Solution& solution) {
  const std::vector<int> all = data.rows;
  const Eigen::Index lines = data.line_table().most();
  const ArmState start = solution.state;
  // Of many rows, only the last solution is computed to the full tolerance.
  const bool many = is_many(data, parameters);
  const double tolerance = many ? kSolvedRoughly : kSolved;
  solution = solve(data, start, parameters, tolerance);
  Leverage leverage(data, solution, parameters);
  bool leverage_is_current = true;  // it belongs to `solution`
  std::vector<int> taken;
  bool came_back = false;
  double scatter = 1.0;
  std::set<int> kept_whole;  // set-ups of which nothing is taken out
  for (;;) {
    if (!many && !leverage_is_current) leverage = Leverage(data, solution, parameters);
    const Eigen::VectorXd distance =
        comparable(leverage.distances(data, solution), data.line_table(), lines);
    scatter = usual_scatter(distance, lines);
    FarRows far = far_from_the_rest(data, distance, lines, plain_distances(data, solution));
    const bool restored = keep_setups(data, all, kept_whole, taken, far);
    if (many && far.rows.empty() && !restored && !leverage_is_current) {
      // The leverage of a fit with more rows is an approximation; the last look needs the exact
      // one.
      leverage = Leverage(data, solution, parameters);
      leverage_is_current = true;
      continue;
    }
    leverage_is_current = false;
    if (!far.rows.empty() || restored) {
      taken.insert(taken.end(), far.rows.begin(), far.rows.end());
      data.rows = far.rest;
      if (static_cast<int>(taken.size()) > most_outliers(all.size())) {
        data.rows = all;
        solution = solve(data, start, parameters, kSolved);
        return {};
      }
    } else {
      const auto back =
          came_back ? std::vector<int>{} : agreeing(data, taken, solution, lines, scatter);
      if (back.empty()) break;
      came_back = true;
      const std::unordered_set<int> returned(back.begin(), back.end());
      std::erase_if(taken, [&](int row) { return returned.contains(row); });
      data.rows.insert(data.rows.end(), back.begin(), back.end());
      std::sort(data.rows.begin(), data.rows.end());
    }
    // Outliers may have pulled the solution far along a flat valley of the cost, so start anew;
    // unless there are many rows and the outliers made only a small share of the cost.
    const ArmState from = many && far.share < kLittleOfCost ? solution.state : start;
    solution = solve(data, from, parameters, tolerance);
  }
  if (many) solution = solve(data, ArmState(solution.state), parameters, kSolved);
  return described(data, taken, solution, lines, scatter);
}

}  // namespace plumb::offline
