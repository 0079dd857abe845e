// SPDX-License-Identifier: Apache-2.0
#include "rt/csv_targets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <sstream>

#include "program/file.hpp"
#include "program/problem.hpp"

namespace plumb::drivers::rt {
namespace {

using Row = std::vector<std::string>;

class CsvFile {
 public:
  explicit CsvFile(const std::filesystem::path& file) : name_(display_name(file)) {
    std::istringstream lines(read_file(file));
    for (std::string line; std::getline(lines, line);) take(line);
    if (columns_.empty()) refuse(1, "has no header row");
  }

  const std::vector<std::pair<int, Row>>& rows() const { return rows_; }

  /// The number in a column; none if there is no such column.
  std::optional<double> number(int line, const Row& row, const std::string& column) const {
    const auto found = columns_.find(column);
    if (found == columns_.end()) return std::nullopt;
    if (found->second >= row.size()) refuse(line, fmt::format("no value for '{}'", column));
    const std::string& text = row[found->second];
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !std::isfinite(value))
      refuse(line, fmt::format("'{}' is '{}': not a finite number", column, text));
    return value;
  }

  bool has(const std::string& column) const { return columns_.contains(column); }

  double need(int line, const Row& row, const std::string& column) const {
    const auto value = number(line, row, column);
    if (!value) refuse(1, fmt::format("has no column '{}'", column));
    return *value;
  }

  [[noreturn]] void refuse(int line, const std::string& what) const {
    throw Failure(Exit::kInput, {.code = "E-RT-CSV",
                                 .message = fmt::format("{}: {}", name_, what),
                                 .place = Place{.file = name_, .line = line},
                                 .help = "columns: x_mm,y_mm,z_mm,qw,qx,qy,qz,q1_deg,q2_deg,…"});
  }

 private:
  void take(std::string line) {
    ++line_;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty() || line.front() == '#') return;
    Row row;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    if (!columns_.empty()) {
      rows_.emplace_back(line_, row);
      return;
    }
    for (std::size_t i = 0; i < row.size(); ++i) columns_.emplace(row[i], i);
  }

  std::string name_;
  int line_ = 0;
  std::map<std::string, std::size_t> columns_;
  std::vector<std::pair<int, Row>> rows_;
};

double joint(const CsvFile& csv, int line, const Row& row, int i) {
  const std::string name = fmt::format("q{}", i + 1);
  if (const auto deg = csv.number(line, row, name + "_deg")) return *deg * std::numbers::pi / 180.0;
  if (const auto rad = csv.number(line, row, name + "_rad")) return *rad;
  if (const auto mm = csv.number(line, row, name + "_mm")) return 1e-3 * *mm;
  return csv.need(line, row, name + "_deg");
}

CsvTarget target(const CsvFile& csv, int line, const Row& row, int joints) {
  format::Pose pose;
  const char* const lengths[] = {"x_mm", "y_mm", "z_mm"};
  for (std::size_t k = 0; k < 3; ++k) pose.p[k] = 1e-3 * csv.need(line, row, lengths[k]);
  const std::array turns{"qw", "qx", "qy", "qz"};
  const bool turned = std::ranges::any_of(turns, [&](const char* turn) { return csv.has(turn); });
  double square = turned ? 0.0 : 1.0;
  for (std::size_t k = 0; turned && k < turns.size(); ++k) {
    pose.q[k] = csv.need(line, row, turns[k]);
    square += pose.q[k] * pose.q[k];
  }
  if (!(square > 0.25) || !std::isfinite(square))
    csv.refuse(line, "qw, qx, qy, qz are no rotation");
  for (double& q : pose.q) q /= std::sqrt(square);
  CsvTarget out{.X_BD = from_pose(pose), .q = {}};
  for (int i = 0; i < joints; ++i) out.q.push_back(joint(csv, line, row, i));
  return out;
}

}  // namespace

std::vector<CsvTarget> read_csv_targets(const std::filesystem::path& file, int joints) {
  const CsvFile csv(file);
  std::vector<CsvTarget> out;
  for (const auto& [line, row] : csv.rows()) out.push_back(target(csv, line, row, joints));
  if (out.empty()) csv.refuse(2, "has no rows");
  return out;
}

}  // namespace plumb::drivers::rt
