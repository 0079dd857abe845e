// SPDX-License-Identifier: Apache-2.0
#include "cli/dh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "cell/assumed_limits.hpp"
#include "cli/dh_table.hpp"
#include "plumb/format/limits.hpp"
#include "program/bounded_file.hpp"
#include "program/file.hpp"
#include "show/units.hpp"

namespace plumb::offline::cli {
namespace {

constexpr const char* kHeader =
    "header: joint,alpha_deg,a_mm,d_mm,theta_deg,q_min_deg,q_max_deg,q_min_mm,q_max_mm,type; also "
    "beta_deg, and offset_deg or offset_mm, which is added to the joint's value";

/// The columns of a DH table, checked; problems of the whole file are collected.
class DhReader {
 public:
  /// `found`: what is wrong with the text of the table.
  DhReader(const Table& table, std::vector<Problem> found)
      : table_(table), problems_(std::move(found)) {}

  std::vector<format::JointRow> rows(Outcome& outcome) {
    std::vector<format::JointRow> out(table_.rows());
    check_count();
    check_columns();
    for (int i = 0; i < table_.rows(); ++i) name(i, out[i]);
    fill("alpha", Quantity::kAngle, &format::JointRow::alpha, out);
    fill("a", Quantity::kLength, &format::JointRow::a, out);
    fill("d", Quantity::kLength, &format::JointRow::d, out);
    fill("theta", Quantity::kAngle, &format::JointRow::theta, out);
    if (table_.find("beta")) fill("beta", Quantity::kAngle, &format::JointRow::beta, out);
    for (int i = 0; i < table_.rows(); ++i) offset(i, out[i]);
    for (int i = 0; i < table_.rows(); ++i) limits(i, out[i]);
    if (!problems_.empty()) throw Failure(Exit::kInput, std::move(problems_));
    if (std::find(assumed_.begin(), assumed_.end(), true) != assumed_.end()) note_limits(outcome);
    warn_of_radians(outcome);
    return out;
  }

  /// Joints whose limits the table does not give.
  const std::vector<bool>& assumed() const { return assumed_; }

 private:
  void problem(std::string code, std::string message, std::string help, int row = -1) {
    Place place{.file = table_.file};
    if (row >= 0) place.line = table_.lines[row];
    problems_.push_back({.code = std::move(code),
                         .message = std::move(message),
                         .place = place,
                         .help = std::move(help)});
  }

  void check_count() {
    if (table_.rows() > format::kMaxJoints)
      problem("E-DH-JOINTS",
              fmt::format("{} joints; plumb goes up to {}", table_.rows(), format::kMaxJoints),
              "one row a joint, from base to tip");
  }

  /// A column that is left out describes another arm.
  void check_columns() {
    constexpr std::array kRead{"joint", "alpha",  "a",     "d",     "theta",
                               "beta",  "offset", "q_min", "q_max", "type"};
    for (const Column& column : table_.columns)
      if (std::find(kRead.begin(), kRead.end(), column.name) == kRead.end())
        problem("E-DH-COLUMN", fmt::format("column '{}' is none of a DH table", column.header),
                fmt::format("rename it, or remove it if it says nothing of the arm; {}", kHeader));
  }

  const std::string* text(const char* column, int row) const {
    const Column* found = table_.find(column);
    return found && found->quantity == Quantity::kText ? &found->text[row] : nullptr;
  }

  void name(int i, format::JointRow& row) {
    const std::string* joint = text("joint", i);
    row.name = joint && !joint->empty() ? *joint : fmt::format("J{}", i + 1);
    const std::string* type = text("type", i);
    if (!type || type->empty() || *type == "revolute") return;
    if (*type == "prismatic")
      row.type = format::JointType::kPrismatic;
    else
      problem("E-DH-TYPE", fmt::format("type '{}' is not known", *type),
              "write revolute or prismatic", i);
  }

  void fill(const char* name, Quantity quantity, double format::JointRow::*field,
            std::vector<format::JointRow>& rows) {
    const char* unit = quantity == Quantity::kAngle ? "deg" : "mm";
    const Column* column = table_.find(name);
    if (!column || column->quantity != quantity)
      return problem("E-DH-COLUMN", fmt::format("column '{}_{}' is missing", name, unit), kHeader);
    for (int i = 0; i < table_.rows(); ++i) rows[i].*field = column->values[i];
  }

  void offset(int i, format::JointRow& row) {
    const bool slide = show::slides(row);
    const auto kind = slide ? Quantity::kLength : Quantity::kAngle;
    const auto other = slide ? Quantity::kAngle : Quantity::kLength;
    row.offset = limit("offset", kind, i).value_or(0.0);
    if (limit("offset", other, i).value_or(0.0) != 0.0)
      problem("E-DH-OFFSET",
              fmt::format("joint {} {}, but its offset is {}", row.name, slide ? "slides" : "turns",
                          slide ? "an angle" : "a length"),
              slide ? "write it into offset_mm" : "write it into offset_deg", i);
  }

  /// Angles of arms are mostly quarter turns: numbers in degrees that are multiples of pi/4 are
  /// not.
  void warn_of_radians(Outcome& outcome) const {
    constexpr double kEighth = std::numbers::pi / 4.0, kRounded = 2e-3;
    std::vector<std::string> seen;
    for (const Column& column : table_.columns) {
      if (column.unit != "deg" || column.name.starts_with("q_")) continue;
      for (const double angle : column.values) {
        const double written = show::to_deg(angle), steps = std::round(written / kEighth);
        if (steps == 0.0 || std::isnan(written)) continue;
        if (std::abs(written - steps * kEighth) > kRounded || std::abs(steps) > 8.0) return;
        std::string text = fmt::format("{:.7g} of {}", written, column.header);
        if (std::find(seen.begin(), seen.end(), text) == seen.end())
          seen.push_back(std::move(text));
      }
    }
    if (seen.empty()) return;
    outcome.remarks.push_back(
        {.severity = Severity::kWarning,
         .code = "W-DH-RADIANS",
         .message = fmt::format("every angle but zero is a multiple of pi/4, so these degrees look "
                                "like radians: {}",
                                fmt::join(seen, ", ")),
         .place = Place{.file = table_.file, .line = table_.header_line},
         .help = "if they are, write _rad instead of _deg into the header"});
  }

  /// What stands in the column of that kind; nothing if there is none, or the cell is empty.
  std::optional<double> limit(const char* name, Quantity quantity, int row) const {
    const auto found =
        std::find_if(table_.columns.begin(), table_.columns.end(),
                     [&](const Column& c) { return c.name == name && c.quantity == quantity; });
    if (found == table_.columns.end() || std::isnan(found->values[row])) return std::nullopt;
    return found->values[row];
  }

  void limits(int i, format::JointRow& row) {
    const bool slide = show::slides(row);
    const auto kind = slide ? Quantity::kLength : Quantity::kAngle;
    const auto other = slide ? Quantity::kAngle : Quantity::kLength;
    const auto low = limit("q_min", kind, i), high = limit("q_max", kind, i);
    row.q_max = slide ? kAssumedTravel_m : kAssumedTurn;
    row.q_min = -row.q_max;
    assumed_.push_back(!low && !high);
    if (low.has_value() != high.has_value())
      return problem("E-DH-LIMITS",
                     fmt::format("joint {}: only one of q_min and q_max is given", row.name),
                     "give both, or leave both empty", i);
    if (!low && (limit("q_min", other, i) || limit("q_max", other, i)))
      return problem("E-DH-LIMITS",
                     fmt::format("joint {} {}, but its limits are {}", row.name,
                                 slide ? "slides" : "turns", slide ? "angles" : "lengths"),
                     fmt::format("write them into q_min_{0} and q_max_{0}; leave the others empty",
                                 slide ? "mm" : "deg"),
                     i);
    if (!low) return;
    row.q_min = *low;
    row.q_max = *high;
    if (!(row.q_min < row.q_max))
      problem("E-DH-LIMITS", fmt::format("joint {}: q_min is not below q_max", row.name),
              "swap or correct the limits", i);
  }

  void note_limits(Outcome& outcome) const {
    outcome.remarks.push_back(
        {.severity = Severity::kNote,
         .code = "N-DH-LIMITS",
         .message = fmt::format("joint limits are not all given: up to ±{:.0f} deg and ±{:.0f} mm "
                                "are assumed",
                                show::to_deg(kAssumedTurn), show::to_mm(kAssumedTravel_m)),
         .help = "add q = [min, max] of the data sheet in cell.toml"});
  }

  const Table& table_;
  std::vector<Problem> problems_;
  std::vector<bool> assumed_;
};

}  // namespace

DhTable read_dh(const std::filesystem::path& file, format::Convention convention,
                Outcome& outcome) {
  const std::string text = read_file_up_to(file, kMostCellBytes);
  outcome.inputs.push_back({display_name(file), sha256(text)});
  ProblemList problems;
  const Table table = parse_dh_table(text, display_name(file), problems);
  if (table.columns.empty()) problems.stop_on_errors();
  DhReader reader(table, problems.errors());
  DhTable out;
  out.chain.convention = convention;
  out.chain.joints = reader.rows(outcome);
  out.assumed_limits = reader.assumed();
  return out;
}

}  // namespace plumb::offline::cli
