// SPDX-License-Identifier: Apache-2.0
#include "import/completeness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <string_view>

#include "cell/column_names.hpp"
#include "cell/reading_kind.hpp"
#include "import/content.hpp"
#include "import/heading.hpp"
#include "import/map_option.hpp"
#include "import/words.hpp"

namespace plumb::offline {
namespace {

constexpr std::size_t kListed = 12;  // columns named in one message

int last_joint(const Imported& data) {
  int last = 0;
  for (const auto& column : data.columns) last = std::max(last, joint_number(column.name, "q"));
  return last;
}

std::vector<std::string> missing_joints(const Imported& data, int wanted) {
  std::vector<std::string> out;
  for (int j = 1; j <= wanted; ++j)
    if (data.find(fmt::format("q{}", j)) == nullptr) out.push_back(fmt::format("q{}", j));
  return out;
}

double largest_of(const std::vector<const UnusedColumn*>& columns) {
  double out = 0.0;
  for (const auto* column : columns) out = std::max(out, column->largest);
  return out;
}

/// Unused columns that differ by a number only, or that speak of joints, in the order of the file.
std::vector<const UnusedColumn*> joint_candidates(const Imported& data) {
  std::map<std::string, std::vector<const UnusedColumn*>> families;
  for (const auto& column : data.unused) {
    std::string stem = folded(column.from);
    const bool joint = stem.find("joint") != stem.npos;
    const auto size = stem.size();
    std::erase_if(stem, [](unsigned char c) { return std::isdigit(c) != 0; });
    if (joint || stem.size() < size) families[joint ? "joint" : stem].push_back(&column);
  }
  std::vector<const UnusedColumn*> out;
  for (const auto& [stem, columns] : families)
    if (columns.size() > out.size()) out = columns;
  return out.size() > 1 ? out : std::vector<const UnusedColumn*>{};
}

/// Three unused columns whose names differ by x, y, z only.
std::vector<const UnusedColumn*> point_candidates(const Imported& data) {
  const auto find = [&](const std::string& name) -> const UnusedColumn* {
    for (const auto& column : data.unused)
      if (column.from == name) return &column;
    return nullptr;
  };
  for (const auto& column : data.unused)
    for (const char first : {'x', 'X'}) {
      const auto at = column.from.rfind(first);
      if (at == column.from.npos) continue;
      std::vector<const UnusedColumn*> out{&column};
      for (int k = 1; k < 3; ++k) {
        std::string other = column.from;
        other[at] = static_cast<char>(first + k);
        if (const auto* found = find(other)) out.push_back(found);
      }
      if (out.size() == 3) return out;
    }
  return {};
}

/// Points of several reflectors in one row, "x1_mm,y1_mm,...,z3_mm": the columns of each.
std::vector<std::vector<std::string>> reflectors(const Imported& data) {
  std::map<std::string, std::map<char, std::string>> points;  // name with '?' for the axis
  const auto look_at = [&](const std::string& from) {
    const std::string name = folded(read_heading(from).name);
    const auto axis = name.find_first_of("xyz");
    const bool numbered =
        std::any_of(name.begin(), name.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
    if (!numbered || axis == name.npos || name.find_first_of("xyz", axis + 1) != name.npos) return;
    std::string point = name;
    point[axis] = '?';
    points[point][name[axis]] = from;
  };
  for (const auto& column : data.columns) look_at(column.from);
  for (const auto& column : data.unused) look_at(column.from);
  std::vector<std::vector<std::string>> out;
  for (const auto& [point, axes] : points)
    if (axes.size() == 3) out.push_back({axes.at('x'), axes.at('y'), axes.at('z')});
  return out.size() > 1 ? out : std::vector<std::vector<std::string>>{};
}

/// Two angles and a distance, as a tracker or a theodolite measures them: their columns.
std::vector<std::string> polar_columns(const Imported& data) {
  const std::vector<std::string> kinds[] = {
      {"az", "azimuth", "azimut", "hz", "horizontal", "horizontalangle", "hor", "ha", "theta"},
      {"el", "elevation", "elev", "zenith", "zenit", "v", "vertical", "verticalangle", "ver", "va",
       "phi", "inclination"},
      {"dist", "distance", "distanz", "d", "range", "slopedistance", "sd", "r", "radius", "rho"}};
  std::vector<std::string> out;
  for (const auto& words : kinds)
    for (const auto& column : data.unused) {
      const std::string name = folded(read_heading(column.from).name);
      if (std::find(words.begin(), words.end(), name) == words.end()) continue;
      out.push_back(column.from);
      break;
    }
  return out.size() == 3 ? out : std::vector<std::string>{};
}

/// What else than x, y and z the columns hold of a point, and what to do; empty if nothing.
struct OtherPoint {
  std::string is, remedy;
};

std::string unit_of_reflector(const Imported& data, const std::string& from) {
  const WrittenHeading heading = read_heading(from);
  if (!heading.unit.empty()) return heading.unit;
  for (const auto& column : data.unused)
    if (column.from == from) return unit_choice("x", column.largest).text();
  return "mm";
}

OtherPoint other_point(const Imported& data) {
  if (const auto points = reflectors(data); !points.empty()) {
    std::vector<std::string> wishes;
    for (std::size_t k = 0; k < 3; ++k)
      wishes.push_back(
          fmt::format("{}={}_{}", points[0][k], "xyz"[k], unit_of_reflector(data, points[0][k])));
    return {
        fmt::format("{} points stand in every row, as of so many reflectors", points.size()),
        fmt::format("take one of them: {}; or import each into a file of its own, and make each "
                    "a [[measurement.setup]]",
                    map_option(wishes))};
  }
  if (const auto polar = polar_columns(data); !polar.empty())
    return {
        fmt::format("{} are polar coordinates", fmt::join(polar, ", ")),
        fmt::format("convert them: with a = {}, e = {}, d = {}, if e counts from the "
                    "horizontal: x = d cos e cos a, y = d cos e sin a, z = d sin e; if e counts "
                    "from the vertical: x = d sin e cos a, y = d sin e sin a, z = d cos e",
                    polar[0], polar[1], polar[2])};
  return {};
}

std::string unused_names(const Imported& data) {
  std::vector<std::string> out;
  for (const auto& column : data.unused)
    if (out.size() < kListed) out.push_back(column.from);
  if (out.empty()) return "no other column holds numbers";
  return fmt::format("columns not used: {}{}", fmt::join(out, ", "),
                     data.unused.size() > kListed ? ", ..." : "");
}

/// Whether the rows are about artefacts instead of having measured positions: the labels of points
/// that a tracker measured are all different.
bool reads_artefacts(const Imported& data) {
  return std::ranges::any_of(artefact_readings(), [&](const ReadingDescriptor& kind) {
    const ImportedColumn* label = data.find(kind.label);
    if (label == nullptr) return false;
    std::set<std::string_view> labels;
    for (std::size_t i = 0; i < label->text.size(); ++i) labels.insert(label->text[i]);
    return labels.size() < label->text.size();
  });
}

}  // namespace

std::optional<Problem> missing_for_calibration(const Imported& data, int joints) {
  const int last = last_joint(data);
  const auto lacking = missing_joints(data, std::max({1, last, joints}));
  const bool no_point = data.find("x") == nullptr && data.find("y") == nullptr &&
                        data.find("z") == nullptr && !reads_artefacts(data);
  if (lacking.empty() && !no_point) return std::nullopt;
  std::vector<std::string> what, wishes;
  if (last == 0)
    what.push_back("joint positions (q1, q2, ...)");
  else if (!lacking.empty())
    what.push_back(fmt::format(
        "joint position{} {}{}", lacking.size() == 1 ? "" : "s", fmt::join(lacking, ", "),
        joints > last ? fmt::format(" of an arm of {} joints", joints) : ""));
  if (no_point) what.push_back("the measured position (x, y, z)");
  const auto propose = [&](const std::vector<const UnusedColumn*>& columns,
                           const std::vector<std::string>& names) {
    const double largest = largest_of(columns);
    for (std::size_t k = 0; k < std::min(columns.size(), names.size()); ++k)
      wishes.push_back(fmt::format("{}={}_{}", columns[k]->from, names[k],
                                   unit_choice(names[k], largest).text()));
  };
  const OtherPoint other = no_point ? other_point(data) : OtherPoint{};
  if (!lacking.empty()) {
    const auto candidates = joint_candidates(data);
    auto names = lacking;
    if (last == 0) names = missing_joints(data, static_cast<int>(candidates.size()));
    propose(candidates, names);
  }
  if (no_point && other.is.empty()) propose(point_candidates(data), {"x", "y", "z"});
  std::string help = wishes.empty() ? "name the columns: --map \"OLD=q1_deg,OTHER=x_mm\""
                                    : "if these are meant: " + map_option(wishes);
  if (help.find('|') != help.npos) help += "  (keep one of the units that | divides)";
  if (!other.is.empty()) help = other.remedy;
  help += "; if another file holds them: plumb import FILE OTHER --join pose";
  return Problem{.severity = Severity::kError,
                 .code = "E-IMPORT-MISSING",
                 .message = fmt::format("no column holds {}, which a calibration needs; {}",
                                        fmt::join(what, " or "),
                                        other.is.empty() ? unused_names(data) : other.is),
                 .place = Place{.file = data.file},
                 .help = std::move(help)};
}

}  // namespace plumb::offline
