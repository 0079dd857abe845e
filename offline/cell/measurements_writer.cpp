// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "cell/measurements.hpp"
#include "cell/units.hpp"

namespace plumb::offline {
namespace {

std::string joined(const std::vector<std::string>& cells) {
  std::string out;
  for (const auto& cell : cells) out += (out.empty() ? "" : ",") + cell;
  return out + "\n";
}

const char* text_of(SetMark mark) {
  switch (mark) {
    case SetMark::kFit:
      return "fit";
    case SetMark::kHeld:
      return "held";
    case SetMark::kIgnore:
      return "ignore";
    default:
      return "";
  }
}

bool has_marks(const Measurements& m) {
  for (SetMark mark : m.set)
    if (mark != SetMark::kUnmarked) return true;
  return false;
}

std::vector<std::string> header(const Measurements& m, const std::vector<bool>& is_angle,
                                const std::vector<Column>& extra) {
  std::vector<std::string> out{"pose"};
  if (has_marks(m)) out.emplace_back("set");
  for (std::size_t i = 0; i < is_angle.size(); ++i)
    out.push_back(fmt::format("q{}_{}", i + 1, is_angle[i] ? "deg" : "mm"));
  const char* const axes[] = {"x_mm", "y_mm", "z_mm"};
  for (int k = 0; k < 3; ++k)
    if (m.has_axis[k]) out.emplace_back(axes[k]);
  if (m.has_orientation()) out.insert(out.end(), {"qw", "qx", "qy", "qz"});
  if (m.sigma_m.rows() > 0) out.insert(out.end(), {"sx_um", "sy_um", "sz_um"});
  if (m.nominal_B.rows() > 0) out.insert(out.end(), {"nx_mm", "ny_mm", "nz_mm"});
  for (const auto& column : extra) out.push_back(column.header);
  return out;
}

}  // namespace

std::string write_measurements(const Measurements& m, const std::vector<bool>& is_angle,
                               const std::vector<std::pair<std::string, std::string>>& comments,
                               const std::vector<Column>& extra) {
  std::string out;
  for (const auto& [key, value] : comments) out += fmt::format("# {}: {}\n", key, value);
  out += joined(header(m, is_angle, extra));
  const bool marks = has_marks(m);
  std::vector<std::string> cells;
  const auto add = [&](double x) { cells.push_back(fmt::format("{}", x == 0.0 ? 0.0 : x)); };
  for (int i = 0; i < m.size(); ++i) {
    cells = {m.pose[i]};
    if (marks) cells.emplace_back(text_of(m.set[i]));
    for (std::size_t k = 0; k < is_angle.size(); ++k)
      add(m.q(i, k) / (is_angle[k] ? M_PI / 180.0 : 1e-3));
    for (int k = 0; k < 3; ++k)
      if (m.has_axis[k]) add(m.p_M(i, k) * 1e3);
    for (int k = 0; k < 4 && m.has_orientation(); ++k) add(m.quat_M(i, k));
    for (int k = 0; k < 3 && m.sigma_m.rows() > 0; ++k) add(m.sigma_m(i, k) * 1e6);
    for (int k = 0; k < 3 && m.nominal_B.rows() > 0; ++k) add(m.nominal_B(i, k) * 1e3);
    for (const auto& column : extra) {
      const Unit unit = unit_of(column.unit).value_or(Unit{});
      if (column.quantity == Quantity::kText)
        cells.push_back(column.text[i]);
      else
        add((column.values[i] - unit.offset) / unit.scale);
    }
    out += joined(cells);
  }
  return out;
}

}  // namespace plumb::offline
