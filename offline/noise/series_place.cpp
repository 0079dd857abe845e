// SPDX-License-Identifier: Apache-2.0
#include "noise/series_place.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "noise/constants.hpp"

namespace plumb::offline {
namespace {

std::string repeat_of(const Column& column, int row) {
  const auto at = static_cast<std::size_t>(row);
  return column.values.empty() ? column.text[at] : fmt::format("{:g}", column.values[at]);
}

}  // namespace

SeriesPlace::SeriesPlace(const MeasurementFiles& own) : own_(own), clock_(clock_of(own.tables)) {
  const Eigen::VectorXd& t = own.context.time_s;
  for (Eigen::Index i = 0; i < t.size(); ++i) {
    if (std::isnan(t(i))) continue;
    by_time_.emplace_back(t(i), static_cast<double>(i));
    if (!(last_s_ >= t(i))) last_s_ = t(i);
  }
  std::sort(by_time_.begin(), by_time_.end());
  const auto names = names_of(own);
  for (std::size_t i = 0; i < names.size(); ++i)
    if (!names[i].empty()) {
      rows_named_[names[i]].push_back(static_cast<int>(i));
      // Another file may name the pose but have no column `repeat`.
      if (!names[i].ends_with('\n'))
        rows_named_[names[i].substr(0, names[i].find('\n') + 1)].push_back(static_cast<int>(i));
    }
}

/// The kind of time stamps that all files have.
SeriesPlace::Clock SeriesPlace::clock_of(const std::vector<Table>& tables) {
  const auto all = [&](const char* name, bool text) {
    return !tables.empty() && std::all_of(tables.begin(), tables.end(), [&](const Table& table) {
      const Column* column = table.find(name);
      return column != nullptr && (text ? !column->text.empty() : !column->values.empty());
    });
  };
  if (all("t", false)) return Clock::kSeconds;
  return all("time", true) ? Clock::kIso : Clock::kNone;
}

/// Pose and repeat of each row; empty where its file names no poses.
std::vector<std::string> SeriesPlace::names_of(const MeasurementFiles& rows) {
  std::vector<std::string> out;
  for (const auto& table : rows.tables) {
    const Column* repeat = table.find("repeat");
    const bool named = table.find("pose") != nullptr;
    for (int i = 0; i < table.rows(); ++i) {
      if (!named)
        out.emplace_back();
      else
        out.push_back(fmt::format("{}\n{}", rows.pose[out.size()],
                                  repeat != nullptr ? repeat_of(*repeat, i) : std::string()));
    }
  }
  return out;
}

/// Order at a time between two rows of the series, by linear interpolation.
double SeriesPlace::order_at(double time_s) const {
  const auto after =
      std::lower_bound(by_time_.begin(), by_time_.end(), std::pair(time_s, -HUGE_VAL));
  if (after == by_time_.end()) return static_cast<double>(own_.size());
  if (after->first == time_s) return after->second;
  if (after == by_time_.begin()) return -1.0;
  const auto before = after - 1;
  const double share = (time_s - before->first) / (after->first - before->first);
  return before->second + share * (after->second - before->second);
}

/// The own row of that name at the same joint positions, or -1. Of several, the one that has
/// `times` others before it, or the last one.
int SeriesPlace::named(const std::string& name, const MeasurementFiles& rows, int row,
                       int times) const {
  const auto found = rows_named_.find(name);
  if (name.empty() || found == rows_named_.end()) return -1;
  int out = -1;
  for (const int own : found->second) {
    if ((own_.q.row(own) - rows.q.row(row)).cwiseAbs().maxCoeff() > kSameJoints) continue;
    out = own;
    if (times-- == 0) break;
  }
  return out;
}

std::vector<bool> SeriesPlace::place(MeasurementFiles& rows) const {
  const int n = rows.size();
  const bool timed = !by_time_.empty();
  const bool one_clock = timed && clock_ != Clock::kNone && clock_of(rows.tables) == clock_ &&
                         rows.context.time_s.size() == n;
  const Eigen::VectorXd given_s = rows.context.time_s;
  const auto names = names_of(rows);
  rows.context.order = Eigen::VectorXd::Constant(n, static_cast<double>(own_.size()));
  rows.context.time_s = timed ? Eigen::VectorXd::Constant(n, last_s_).eval() : Eigen::VectorXd();
  std::vector<bool> placed(static_cast<std::size_t>(n), false);
  const auto as_own = [&](int row, int own) {
    rows.context.order(row) = own;
    if (timed) rows.context.time_s(row) = own_.context.time_s(own);
    placed[static_cast<std::size_t>(row)] = true;
  };
  std::map<std::string, int> seen;
  int first = 0;
  for (const auto& table : rows.tables) {
    int own = 0;
    bool same = false;
    for (const auto& mine : own_.tables) {
      same = mine.sha256 == table.sha256 && mine.rows() == table.rows();
      if (same) break;
      own += mine.rows();
    }
    for (int i = first; i < first + table.rows(); ++i) {
      const auto at = static_cast<std::size_t>(i);
      if (same) {
        as_own(i, own + i - first);
        rows.context.step.row(i) = own_.context.step.row(own + i - first);
      } else if (one_clock && !std::isnan(given_s(i))) {
        const double held = std::clamp(given_s(i), by_time_.front().first, by_time_.back().first);
        rows.context.order(i) = order_at(given_s(i));
        rows.context.time_s(i) = held;
        placed[at] = std::abs(given_s(i) - held) <=
                     kBeyondSeries * (by_time_.back().first - by_time_.front().first);
      } else if (const int twin = named(names[at], rows, i, seen[names[at]]++); twin >= 0) {
        as_own(i, twin);
      }
    }
    first += table.rows();
  }
  return placed;
}

}  // namespace plumb::offline
