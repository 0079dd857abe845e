// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "cell/csv_line.hpp"
#include "cell/measurements.hpp"
#include "cell/units.hpp"

namespace plumb::offline {
namespace {

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

/// The file, cell by cell.
class Writer {
 public:
  Writer(const Measurements& m, const JointColumns& joints, const std::vector<Column>& extra)
      : m_(m), is_angle_(joints.is_angle), q_(m.q), extra_(extra) {
    to_values(joints.coupling, q_);
    marked_ = std::any_of(m.set.begin(), m.set.end(),
                          [](SetMark mark) { return mark != SetMark::kUnmarked; });
    for (const auto& column : extra) units_.push_back(unit_of(column.unit).value_or(Unit{}));
  }

  std::string write(const std::vector<std::pair<std::string, std::string>>& comments) {
    for (const auto& [key, value] : comments)
      out_ += fmt::format("# {}: {}\n", one_line(key), one_line(value));
    header();
    for (int i = 0; i < m_.size(); ++i) row(i);
    return std::move(out_);
  }

 private:
  static std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    std::replace(text.begin(), text.end(), '\r', ' ');
    return text;
  }

  void cell(const std::string& text) {
    if (column_++ > 0) out_ += ',';
    out_ += text;
  }

  void end_row() {
    out_ += '\n';
    column_ = 0;
  }

  void axes_header(const char* prefix, const char* unit) {
    for (int k = 0; k < 3; ++k)
      if (m_.has_axis[k]) cell(fmt::format("{}{}_{}", prefix, "xyz"[k], unit));
  }

  void header() {
    cell("pose");
    if (marked_) cell("set");
    for (std::size_t i = 0; i < is_angle_.size(); ++i)
      cell(fmt::format("q{}_{}", i + 1, is_angle_[i] ? "deg" : "mm"));
    axes_header("", "mm");
    if (m_.has_orientation())
      for (const char* part : {"qw", "qx", "qy", "qz"}) cell(part);
    if (m_.sigma_m.rows() > 0) axes_header("s", "um");
    if (m_.nominal_B.rows() > 0) axes_header("n", "mm");
    for (const auto& column : extra_) cell(quoted_if_needed(column.header));
    end_row();
  }

  void axes(const Rows3& values, int i, const Unit& unit) {
    for (int k = 0; k < 3 && values.rows() > 0; ++k)
      if (m_.has_axis[k]) cell(text_in(unit, values(i, k)));
  }

  void row(int i) {
    cell(quoted_if_needed(m_.pose[i]));
    if (marked_) cell(text_of(m_.set[i]));
    for (std::size_t k = 0; k < is_angle_.size(); ++k)
      cell(text_in(is_angle_[k] ? deg_ : mm_, q_(i, k)));
    axes(m_.p_M, i, mm_);
    for (int k = 0; k < 4 && m_.has_orientation(); ++k) cell(text_in(Unit{}, m_.quat_M(i, k)));
    axes(m_.sigma_m, i, um_);
    axes(m_.nominal_B, i, mm_);
    for (std::size_t k = 0; k < extra_.size(); ++k)
      cell(extra_[k].quantity == Quantity::kText ? quoted_if_needed(extra_[k].text[i])
                                                 : text_in(units_[k], extra_[k].values[i]));
    end_row();
  }

  const Unit mm_ = *unit_of("mm"), um_ = *unit_of("um"), deg_ = *unit_of("deg");
  const Measurements& m_;
  const std::vector<bool>& is_angle_;
  RowsN q_;  // values
  const std::vector<Column>& extra_;
  std::vector<Unit> units_;
  std::string out_;
  bool marked_ = false;
  int column_ = 0;
};

}  // namespace

std::string write_measurements(const Measurements& measurements, const JointColumns& joints,
                               const std::vector<std::pair<std::string, std::string>>& comments,
                               const std::vector<Column>& extra) {
  return Writer(measurements, joints, extra).write(comments);
}

}  // namespace plumb::offline
