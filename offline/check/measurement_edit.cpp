// SPDX-License-Identifier: Apache-2.0
#include "check/measurement_edit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "cell/csv_header.hpp"
#include "cell/csv_line.hpp"
#include "cell/csv_number.hpp"
#include "cell/units.hpp"

namespace plumb::offline {
namespace {

using Cells = std::vector<CsvCell>;

bool has_digit_but_zero(std::string_view text) {
  const auto mantissa = text.substr(0, text.find_first_of("eE"));
  return mantissa.find_first_of("123456789") != std::string_view::npos;
}

std::string negated(std::string_view text) {
  if (!has_digit_but_zero(text)) return std::string(text);
  if (text.front() == '-') return std::string(text.substr(1));
  if (text.front() == '+') text.remove_prefix(1);
  return "-" + std::string(text);
}

std::string renamed(std::string_view header, const MeasurementEdit& edit) {
  Heading heading = split_heading(header);
  if (heading.unit.empty()) {  // dir_j1
    const auto name = edit.names.find(std::string(header));
    return name != edit.names.end() ? name->second : std::string(header);
  }
  if (const auto unit = edit.units.find(heading.name); unit != edit.units.end())
    heading.unit = unit->second;
  if (const auto name = edit.names.find(heading.name); name != edit.names.end())
    heading.name = name->second;
  return heading.name + "_" + heading.unit;
}

/// Behind the colon of a line "# rot: xyz-fixed"; npos for any other line.
std::size_t behind_rotation_key(std::string_view line) {
  const auto colon = line.find(':');
  if (colon == std::string_view::npos) return colon;
  std::string_view key = line.substr(0, colon);
  key.remove_prefix(std::min(key.find_first_not_of(" \t#/"), key.size()));
  key = key.substr(0, key.find_last_not_of(" \t") + 1);
  return key == "rot" ? colon + 1 : std::string_view::npos;
}

class RowEditor {
 public:
  explicit RowEditor(const MeasurementEdit& edit) : edit_(edit) {}

  void header(std::string_view line) {
    separator_ = find_separator(line);
    rewrite(line, [&](std::size_t i, std::string_view cell) {
      const Heading heading = split_heading(cell);
      turned_.resize(i + 1);
      turned_[i] = edit_.negated.contains(heading.name) ||
                   edit_.negated.contains(std::string(cell));  // dir_j1 has no unit
      factors_.resize(i + 1, 1.0);
      if (const auto found = edit_.factors.find(heading.name); found != edit_.factors.end())
        factors_[i] = found->second;
      return renamed(cell, edit_);
    });
  }

  void row(std::string_view line) {
    rewrite(line, [&](std::size_t i, std::string_view cell) {
      const bool turn = i < turned_.size() && turned_[i] && !cell.empty();
      return multiplied(turn ? negated(cell) : std::string(cell),
                        i < factors_.size() ? factors_[i] : 1.0);
    });
  }

  void keep(std::string_view line) { out_ += line; }
  void comment(std::string_view line) {
    const auto at = edit_.rotation.empty() ? std::string_view::npos : behind_rotation_key(line);
    if (at == std::string_view::npos) return keep(line);
    out_ += line.substr(0, at);
    out_ += " " + edit_.rotation;
    if (line.ends_with('\r')) out_ += '\r';
  }
  void end_line() { out_ += '\n'; }
  std::string take() { return std::move(out_); }

 private:
  std::string multiplied(std::string cell, double factor) const {
    double value = 0.0;
    if (factor == 1.0 || read_number(cell, separator_, value) != NumberFault::kNone) return cell;
    return fmt::format("{:.9g}", value * factor);
  }

  template <class Change>
  void rewrite(std::string_view line, Change&& change) {
    cut_line(line, separator_, cells_);
    std::size_t done = 0;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const auto begin = static_cast<std::size_t>(cells_[i].text.data() - line.data());
      const std::string by = change(i, cells_[i].text);
      if (cells_[i].text.empty() || by == cells_[i].text) continue;
      out_ += line.substr(done, begin - done);
      out_ += by;
      done = begin + cells_[i].text.size();
    }
    out_ += line.substr(done);
  }

  const MeasurementEdit& edit_;
  char separator_ = ',';
  std::vector<bool> turned_;
  std::vector<double> factors_;
  Cells cells_;
  std::string out_;
};

bool is_comment(std::string_view line) {
  const auto first = line.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return true;
  line.remove_prefix(first);
  return line.front() == '#' || line.starts_with("//");
}

}  // namespace

void MeasurementEdit::add(const MeasurementEdit& other) {
  units.insert(other.units.begin(), other.units.end());
  names.insert(other.names.begin(), other.names.end());
  negated.insert(other.negated.begin(), other.negated.end());
  factors.insert(other.factors.begin(), other.factors.end());
  if (!other.rotation.empty()) rotation = other.rotation;
}

std::string edited(const std::string& text, int header_line, const MeasurementEdit& edit) {
  RowEditor editor(edit);
  std::string_view rest = text;
  for (int number = 1; !rest.empty(); ++number) {
    const auto end = rest.find('\n');
    const std::string_view line = rest.substr(0, end);
    if (number == header_line)
      editor.header(line);
    else if (number < header_line)
      editor.comment(line);
    else if (is_comment(line))
      editor.keep(line);
    else
      editor.row(line);
    if (end == std::string_view::npos) break;
    editor.end_line();
    rest.remove_prefix(end + 1);
  }
  return editor.take();
}

}  // namespace plumb::offline
