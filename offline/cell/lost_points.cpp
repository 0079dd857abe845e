// SPDX-License-Identifier: Apache-2.0
#include "cell/lost_points.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "cell/link_frame.hpp"
#include "numbers/quantile.hpp"

namespace plumb::offline {
namespace {

/// Distance from the flange to the reflector.
constexpr double kLongestTool_m = 1.5;
/// If a larger share of the readings of a set-up is lost, something else is wrong.
constexpr double kMostLost = 0.2;
constexpr std::size_t kMostNamed = 10;

/// No point of the arm is farther than this from its base, tool included.
double farthest(const Cell& cell, const Measurements& measured) {
  double out = kLongestTool_m + stretched_length(cell.nominal);
  for (int k = 0; k < cell.joints(); ++k)
    if (cell.nominal.joints[static_cast<std::size_t>(k)].type == format::JointType::kPrismatic &&
        measured.size() > 0)
      out += measured.q.col(k).cwiseAbs().maxCoeff();
  return out;
}

/// The rows of one set-up that hold no point.
std::vector<int> lost_among(const Measurements& measured, const std::vector<int>& rows,
                            double farthest_m) {
  Eigen::RowVector3d middle;
  for (int k = 0; k < 3; ++k) {
    std::vector<double> values;
    for (const int i : rows) values.push_back(measured.p_M(i, k));
    middle(k) = median(std::move(values));
  }
  const auto& axes = measured.has_axis;
  const bool in_space = axes[0] && axes[1] && axes[2];
  std::vector<int> out;
  for (const int i : rows) {
    const bool at_the_tracker = in_space && (measured.p_M.row(i).array() == 0.0).all();
    if (at_the_tracker || (measured.p_M.row(i) - middle).norm() > 2.0 * farthest_m)
      out.push_back(i);
  }
  const bool few = static_cast<double>(out.size()) <= kMostLost * static_cast<double>(rows.size());
  return few ? out : std::vector<int>{};
}

void warn(MeasurementFiles& measured, const std::vector<int>& lost) {
  const auto file_of = file_of_rows(measured.tables);
  std::map<int, std::vector<int>> by_file;
  for (const int i : lost) by_file[file_of[static_cast<std::size_t>(i)]].push_back(i);
  for (const auto& [file, rows] : by_file) {
    Table& table = measured.tables[static_cast<std::size_t>(file)];
    const auto first = std::find(file_of.begin(), file_of.end(), file) - file_of.begin();
    std::vector<std::string> lines;
    for (const int i : rows) {
      if (lines.size() == kMostNamed) break;
      lines.push_back(fmt::format("{}", table.lines[static_cast<std::size_t>(i - first)]));
    }
    const std::size_t more = rows.size() - lines.size();
    const Eigen::RowVector3d point = 1e3 * measured.p_M.row(rows.front());
    table.remarks.push_back(
        {.severity = Severity::kWarning,
         .code = "W-CSV-LOST",
         .message =
             fmt::format("{} reading{} no point of this arm, as ({:g}, {:g}, {:g}) mm, and "
                         "{} left out: line{} {}{}",
                         rows.size(), rows.size() == 1 ? " is" : "s are", point.x(), point.y(),
                         point.z(), rows.size() == 1 ? "is" : "are", rows.size() == 1 ? "" : "s",
                         fmt::join(lines, ", "), more > 0 ? fmt::format(" and {} more", more) : ""),
         .place = Place{.file = table.file, .line = std::stoi(lines.front())},
         .help = "measure there again, or mark them: column set = ignore"});
  }
}

}  // namespace

void ignore_lost_points(const Cell& cell, MeasurementFiles& measured) {
  std::map<int, std::vector<int>> setups;
  for (int i = 0; i < measured.size(); ++i)
    if (measured.set[static_cast<std::size_t>(i)] != SetMark::kIgnore && !measured.of_artefact(i))
      setups[measured.setup.empty() ? 0 : measured.setup[static_cast<std::size_t>(i)]].push_back(i);
  const double farthest_m = farthest(cell, measured);
  std::vector<int> lost;
  for (const auto& [setup, rows] : setups) {
    const auto found = lost_among(measured, rows, farthest_m);
    lost.insert(lost.end(), found.begin(), found.end());
  }
  for (const int i : lost) measured.set[static_cast<std::size_t>(i)] = SetMark::kIgnore;
  std::sort(lost.begin(), lost.end());
  warn(measured, lost);
}

}  // namespace plumb::offline
