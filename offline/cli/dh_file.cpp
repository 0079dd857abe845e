// SPDX-License-Identifier: Apache-2.0
#include "cli/dh_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cell/measurements.hpp"
#include "plumb/format/limits.hpp"
#include "show/units.hpp"

namespace plumb::offline::cli {
namespace {

constexpr double kUsualTurn_deg = 180.0;
constexpr double kUsualTravel_m = 1.0;

/// The columns of a DH table, checked; problems of the whole file are collected.
class DhReader {
 public:
  explicit DhReader(const Table& table) : table_(table) {}

  std::vector<format::JointRow> rows(Outcome& outcome) {
    std::vector<format::JointRow> out(table_.rows());
    check_count();
    for (int i = 0; i < table_.rows(); ++i) name(i, out[i]);
    fill("alpha", Quantity::kAngle, &format::JointRow::alpha, out);
    fill("a", Quantity::kLength, &format::JointRow::a, out);
    fill("d", Quantity::kLength, &format::JointRow::d, out);
    fill("theta", Quantity::kAngle, &format::JointRow::theta, out);
    for (int i = 0; i < table_.rows(); ++i) limits(i, out[i]);
    if (!problems_.empty()) throw Failure(Exit::kInput, std::move(problems_));
    if (limits_missing_) note_limits(outcome);
    return out;
  }

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
      return problem("E-DH-COLUMN", fmt::format("column '{}_{}' is missing", name, unit),
                     "header: joint,alpha_deg,a_mm,d_mm,theta_deg,q_min_deg,q_max_deg,type");
    for (int i = 0; i < table_.rows(); ++i) rows[i].*field = column->values[i];
  }

  const Column* limit(const char* name, Quantity quantity) const {
    const auto found =
        std::find_if(table_.columns.begin(), table_.columns.end(),
                     [&](const Column& c) { return c.name == name && c.quantity == quantity; });
    return found == table_.columns.end() ? nullptr : &*found;
  }

  void limits(int i, format::JointRow& row) {
    const bool slide = show::slides(row);
    const auto kind = slide ? Quantity::kLength : Quantity::kAngle;
    const Column* low = limit("q_min", kind);
    const Column* high = limit("q_max", kind);
    limits_missing_ = limits_missing_ || !low || !high;
    const double turn = show::from_deg(kUsualTurn_deg);
    row.q_min = low ? low->values[i] : slide ? 0.0 : -turn;
    row.q_max = high ? high->values[i] : slide ? kUsualTravel_m : turn;
    if (!(row.q_min < row.q_max))
      problem("E-DH-LIMITS", fmt::format("joint {}: q_min is not below q_max", row.name),
              "swap or correct the limits", i);
  }

  void note_limits(Outcome& outcome) const {
    outcome.remarks.push_back(
        {.severity = Severity::kNote,
         .code = "N-DH-LIMITS",
         .message = fmt::format("joint limits are not all given: took -{0:.0f} .. {0:.0f} deg and "
                                "0 .. {1:.0f} mm",
                                kUsualTurn_deg, show::to_mm(kUsualTravel_m)),
         .help = "correct q = [min, max] in cell.toml"});
  }

  const Table& table_;
  std::vector<Problem> problems_;
  bool limits_missing_ = false;
};

}  // namespace

format::Chain read_dh(const std::filesystem::path& file, format::Convention convention,
                      Outcome& outcome) {
  const Table table = read_table(file, TableOf::kRobot);
  outcome.inputs.push_back({table.file, table.sha256});
  outcome.remark(table.remarks);
  format::Chain chain;
  chain.convention = convention;
  chain.joints = DhReader(table).rows(outcome);
  return chain;
}

}  // namespace plumb::offline::cli
