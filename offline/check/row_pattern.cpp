// SPDX-License-Identifier: Apache-2.0
#include "check/row_pattern.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "arm/predicted_points.hpp"
#include "cell/table_place.hpp"
#include "check/constants.hpp"
#include "check/row_lines.hpp"
#include "check/tool_errors.hpp"
#include "numbers/quantile.hpp"

namespace plumb::offline {
namespace {

/// Lines that a message names.
constexpr int kShown = 3;

using Errors = Rows3;

/// The used rows of one file.
struct FileRows {
  int table = 0;
  std::vector<int> row;    // of the joined measurements
  std::vector<int> place;  // in the file, 0 ...
};

std::vector<FileRows> by_file(const MeasurementFiles& measured, const std::vector<int>& rows) {
  std::vector<FileRows> out(measured.tables.size());
  for (const int row : rows) {
    const RowPlace at = row_place(measured, row);
    FileRows& file = out[static_cast<std::size_t>(at.table)];
    file.table = at.table;
    if (static_cast<int>(file.row.size()) == check::kMostOfFile) continue;
    file.row.push_back(row);
    file.place.push_back(at.row);
  }
  std::erase_if(out, [](const FileRows& f) { return f.row.size() < check::kFewestRows; });
  return out;
}

/// Shortens gross errors, so that a few of them decide nothing.
void clip(Errors& errors) {
  std::vector<double> size(static_cast<std::size_t>(errors.rows()));
  for (Eigen::Index i = 0; i < errors.rows(); ++i)
    size[static_cast<std::size_t>(i)] = errors.row(i).norm();
  const double most = check::kClipMedians * median(size);
  for (Eigen::Index i = 0; i < errors.rows(); ++i)
    if (const double s = size[static_cast<std::size_t>(i)]; s > most) errors.row(i) *= most / s;
}

struct Phases {
  int period = 0;
  Errors mean;             // of each place in the pattern, shape (period, 3)
  std::vector<int> count;  // rows of each
  double share = 0.0;      // of the sum of squares
  bool enough = false;     // rows
};

template <class Values>
Phases phases_of(const Values& v, const std::vector<int>& place, int period) {
  Phases out{.period = period, .mean = Errors::Zero(period, 3), .count = {}};
  out.count.assign(static_cast<std::size_t>(period), 0);
  for (Eigen::Index i = 0; i < v.rows(); ++i) {
    const int k = place[static_cast<std::size_t>(i)] % period;
    out.mean.row(k) += v.row(i);
    ++out.count[static_cast<std::size_t>(k)];
  }
  const Eigen::RowVector3d all = v.colwise().mean();
  double between = 0.0;
  out.enough = true;
  for (int k = 0; k < period; ++k) {
    const int n = out.count[static_cast<std::size_t>(k)];
    out.enough = out.enough && n >= check::kFewestOfPlace;
    if (n == 0) continue;
    out.mean.row(k) /= n;
    between += n * (out.mean.row(k) - all).squaredNorm();
  }
  const double total = (v.rowwise() - all).squaredNorm();
  out.share = total > 0.0 ? between / total : 0.0;
  return out;
}

/// The share that chance gives to p means of n rows is near (p - 1) / n; one axis may hold nearly
/// all of the error, so n counts rows and not coordinates.
bool is_sure(const Phases& p, Eigen::Index n) {
  const double free = p.period - 1.0;
  return p.enough && p.share >= check::kPatternShare &&
         p.share * static_cast<double>(n) >
             free + check::kPatternDeviations * std::sqrt(2.0 * free);
}

std::optional<Phases> best_pattern(const Errors& v, const std::vector<int>& place) {
  std::vector<Phases> found;
  double most = 0.0;
  for (int period = 2; period <= check::kLongestPeriod; ++period) {
    Phases p = phases_of(v, place, period);
    if (!is_sure(p, v.rows())) continue;
    most = std::max(most, p.share);
    found.push_back(std::move(p));
  }
  for (auto& p : found)
    if (p.share >= check::kPatternAlike * most) return p;
  return std::nullopt;
}

/// A column that moves with the pattern: joint positions, how they were reached, payload,
/// temperature. Columns of the user's own, such as the face, explain it in words and are no cause.
bool is_followed(const MeasurementFiles& measured, const FileRows& file, int period) {
  const auto follows = [&](const auto& value_of) {
    Errors v = Errors::Zero(static_cast<Eigen::Index>(file.row.size()), 3);
    for (std::size_t i = 0; i < file.row.size(); ++i)
      v(static_cast<Eigen::Index>(i), 0) = value_of(i);
    return phases_of(v, file.place, period).share >
           check::kPatternFollows +
               static_cast<double>(period) / static_cast<double>(file.row.size());
  };
  for (Eigen::Index j = 0; j < measured.q.cols(); ++j) {
    if (follows([&](std::size_t i) { return measured.q(file.row[i], j); })) return true;
    if (follows([&](std::size_t i) { return std::abs(measured.q(file.row[i], j)); })) return true;
    if (follows([&](std::size_t i) {
          const double step =
              i == 0 ? 0.0 : measured.q(file.row[i], j) - measured.q(file.row[i - 1], j);
          return step > 0.0 ? 1.0 : step < 0.0 ? -1.0 : 0.0;
        }))
      return true;
  }
  const Table& table = measured.tables[static_cast<std::size_t>(file.table)];
  for (const Column& column : table.columns) {
    const bool cause = column.name.starts_with("dir_j") || column.name.starts_with("travel_j") ||
                       column.name.starts_with("payload") || column.name.starts_with("temp");
    if (cause && !column.values.empty() && follows([&](std::size_t i) {
          return column.values[static_cast<std::size_t>(file.place[i])];
        }))
      return true;
  }
  return false;
}

/// The places of the pattern that differ from the rest by about one vector.
struct Odd {
  std::vector<int> places;
  Eigen::RowVector3d off = Eigen::RowVector3d::Zero();
};

std::optional<Odd> odd_places(const Phases& p) {
  const Eigen::RowVector3d middle = p.mean.colwise().mean();
  Eigen::Index far = 0;
  (p.mean.rowwise() - middle).rowwise().norm().maxCoeff(&far);
  const Eigen::VectorXd along =
      (p.mean.rowwise() - middle) * (p.mean.row(far) - middle).transpose();
  std::vector<int> order(static_cast<std::size_t>(p.period));
  for (int k = 0; k < p.period; ++k) order[static_cast<std::size_t>(k)] = k;
  std::sort(order.begin(), order.end(), [&](int a, int b) { return along(a) > along(b); });
  std::size_t split = 1;
  for (std::size_t k = 1; k < order.size(); ++k)
    if (along(order[k - 1]) - along(order[k]) > along(order[split - 1]) - along(order[split]))
      split = k;
  Eigen::RowVector3d high = Eigen::RowVector3d::Zero(), low = Eigen::RowVector3d::Zero();
  for (std::size_t k = 0; k < order.size(); ++k) (k < split ? high : low) += p.mean.row(order[k]);
  const auto n_high = static_cast<double>(split);
  const double n_low = p.period - n_high;
  high /= n_high;
  low /= n_low;
  const double explained = n_high * n_low / p.period * (high - low).squaredNorm();
  if (explained < check::kTwoValued * (p.mean.rowwise() - middle).squaredNorm())
    return std::nullopt;
  Odd out;
  const auto cut = order.begin() + static_cast<std::ptrdiff_t>(split);
  const bool few_high = 2 * split <= order.size();
  out.places = few_high ? std::vector<int>(order.begin(), cut) : std::vector<int>(cut, order.end());
  out.off = few_high ? Eigen::RowVector3d(high - low) : Eigen::RowVector3d(low - high);
  return out;
}

std::string ordinal(int n) {
  static const char* const words[] = {"second", "third", "fourth", "fifth", "sixth", "seventh",
                                      "eighth", "ninth", "tenth",  "11th",  "12th"};
  return words[n - 2];
}

double largest_difference(const Phases& p) {
  double out = 0.0;
  for (Eigen::Index a = 0; a < p.period; ++a)
    for (Eigen::Index b = 0; b < a; ++b)
      out = std::max(out, (p.mean.row(a) - p.mean.row(b)).norm());
  return out;
}

Problem described(const MeasurementFiles& measured, const FileRows& file, const Phases& p,
                  bool tool) {
  const Table& table = measured.tables[static_cast<std::size_t>(file.table)];
  const auto odd = odd_places(p);
  const int first_place = odd ? odd->places.front() : 0;
  std::vector<int> lines;
  int at = -1;
  for (const int place : file.place)
    if (place % p.period == first_place && static_cast<int>(lines.size()) < kShown) {
      if (at < 0) at = place;
      lines.push_back(table.lines[static_cast<std::size_t>(place)]);
    }
  const std::string axes = tool ? "tool" : "tracker";
  std::string message;
  if (odd && odd->places.size() == 1)
    message = fmt::format(
        "every {} reading (lines {}, ...) is off from the others by {:.3g} mm, always the same way "
        "in the axes of the {}: {:.3g}, {:.3g}, {:.3g} mm",
        ordinal(p.period), fmt::join(lines, ", "), odd->off.norm() * 1e3, axes, odd->off(0) * 1e3,
        odd->off(1) * 1e3, odd->off(2) * 1e3);
  else
    message = fmt::format(
        "the errors of the readings repeat every {} rows: in the axes of the {} they differ by up "
        "to {:.3g} mm within each {}",
        p.period, axes, largest_difference(p) * 1e3, p.period);
  const Column* column = table.find(measured.has_axis[0] ? "x" : "y");
  return {Severity::kWarning, "W-CHECK-PATTERN",
          fmt::format("{}; that is {:.0f} % of the error", message, 100.0 * p.share),
          column != nullptr && at >= 0
              ? std::optional<Place>(place_in_row(table, at, *column, "the first of these"))
              : std::nullopt,
          tool ? "several reflectors in turn? add a text column 'setup' that says which one it was"
               : "two faces of the instrument, or several stations in turn? average each pair of "
                 "faces, or add a text column 'setup' that says which one it was"};
}

}  // namespace

std::vector<Problem> pattern_findings(const MeasurementFiles& measured,
                                      const std::vector<int>& rows, const ArmState& fitted) {
  std::vector<Problem> out;
  const bool all_axes = measured.has_axis[0] && measured.has_axis[1] && measured.has_axis[2];
  for (const FileRows& file : by_file(measured, rows)) {
    const Measurements some = pick(measured, file.row);
    Errors left = residuals(some, predict_points(fitted, some));
    clip(left);
    const auto of_tracker = best_pattern(left, file.place);
    const auto of_tool = all_axes ? best_pattern(errors_in_tool(fitted, some, left), file.place)
                                  : std::optional<Phases>{};
    if (!of_tracker && !of_tool) continue;
    const bool tool = !of_tracker || (of_tool && of_tool->share > of_tracker->share);
    const Phases& best = tool ? *of_tool : *of_tracker;
    if (!is_followed(measured, file, best.period))
      out.push_back(described(measured, file, best, tool));
  }
  return out;
}

}  // namespace plumb::offline
