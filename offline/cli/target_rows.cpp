// SPDX-License-Identifier: Apache-2.0
#include "cli/target_rows.hpp"

#include <fmt/format.h>

#include <memory>

#include "arm/effect_binding.hpp"
#include "show/units.hpp"

namespace plumb::offline::cli {
namespace {

constexpr std::size_t kMostJointsWithoutCommand = 6;  // arms with more need commanded joints
constexpr std::size_t kUsualRow = 400;                // bytes of a row that is written

void check_seeds(const Targets& targets, const format::Chain& chain,
                 const std::vector<double>& start) {
  const Place place{.file = targets.table.file, .line = targets.table.lines.front()};
  if (chain.joints.size() > kMostJointsWithoutCommand && !targets.commanded)
    throw Failure(Exit::kInput,
                  {.code = "E-TARGET-COMMANDED",
                   .message = "an arm of more than six joints needs the commanded joints",
                   .place = place,
                   .help = "add columns qc1_deg ... to the targets"});
  if (targets.seed.rows() == 0 && start.empty())
    throw Failure(Exit::kInput, {.code = "E-TARGET-SEED",
                                 .message = "the first target has no joint state to start from",
                                 .place = place,
                                 .help = "add columns q1_deg ..., or: --start 0,-90,90,0,90,0"});
}

const Problem& no_orientation() {
  static const Problem note{
      .severity = Severity::kNote,
      .code = "N-TARGET-ORIENTATION",
      .message = "the targets have no quaternion: the nominal orientation at each seed is meant",
      .help = "to say it yourself add columns qw, qx, qy, qz"};
  return note;
}

}  // namespace

std::vector<Problem> limited_remark(const TargetTotals& found) {
  if (found.limited == 0) return {};
  return {{.severity = Severity::kWarning,
           .code = "W-CORRECT-LIMITED",
           .message = fmt::format("{} of {} corrections are larger than the guard allows and were "
                                  "cut to its limit",
                                  found.limited, found.counts.rows()),
           .help = "raise max_correction_mm under [deploy] in cell.toml, then: plumb compile"}};
}

TargetRows::TargetRows(const format::Model& model, std::vector<double> start)
    : poses_(model),
      inputs_(model),
      sensors_(temperature_names(model)),
      joints_(model.nominal),
      chain_(model.nominal),
      start_(start),
      last_(std::move(start)),
      found_(poses_.corrector(), chain_, inputs_) {}

RowStream::Computed TargetRows::compute(Table table, const show::PassThrough& columns) {
  const auto targets = std::make_shared<const Targets>(targets_of(std::move(table), joints_));
  check_seeds(*targets, chain_, start_);
  RowStream::Computed out{.remarks = targets->table.remarks, .append = {}};
  if (targets->quat_B.rows() == 0) out.remarks.push_back(no_orientation());
  if (targets->seed.rows() == 0)
    out.append = [this, targets, &columns](std::string& text) { follow(*targets, columns, text); };
  else
    out.append = solved(*targets, columns);
  return out;
}

/// Rows with a joint state of their own do not depend on each other.
std::function<void(std::string&)> TargetRows::solved(const Targets& targets,
                                                     const show::PassThrough& columns) {
  TargetTotals found(poses_.corrector(), chain_, inputs_);
  found.refusals.name_columns(targets.table);
  std::string text;
  text.reserve(static_cast<std::size_t>(targets.table.rows()) * kUsualRow);
  const auto kind = targets.commanded ? SeedKind::kCommanded : SeedKind::kMeasured;
  for (int row = 0; row < targets.table.rows(); ++row) {
    const auto q = targets.seed.row(row);
    const std::span<const double> seed(q.data(), static_cast<std::size_t>(q.size()));
    append(targets, row, seed,
           corrected_row(poses_, targets, row, seed, kind, sensors_, found.inputs), columns, found,
           text);
  }
  return [this, found, text = std::move(text)](std::string& out) {
    found_.add(found);
    out += text;
  };
}

/// Each row begins where the last one ended.
void TargetRows::follow(const Targets& targets, const show::PassThrough& columns,
                        std::string& text) {
  found_.refusals.name_columns(targets.table);
  for (int row = 0; row < targets.table.rows(); ++row) {
    const auto solved = corrected_row(poses_, targets, row, last_, SeedKind::kLastSolution,
                                      sensors_, found_.inputs);
    append(targets, row, last_, solved, columns, found_, text);
    if (!refused(solved.correction.status))
      std::copy_n(solved.correction.q.begin(), last_.size(), last_.begin());
  }
}

void TargetRows::append(const Targets& targets, int row, std::span<const double> seed,
                        const CorrectedRow& solved, const show::PassThrough& columns,
                        TargetTotals& found, std::string& text) {
  const Status status = solved.correction.status;
  found.counts.add(status);
  if (refused(status)) found.refusals.add(solved.X_BD, seed, status, targets.quat_B.rows() > 0);
  found.limited += solved.limited ? 1 : 0;
  found.faded += solved.faded ? 1 : 0;
  found.largest_m = std::max(found.largest_m, solved.moved_m);
  found.largest_rad = std::max(found.largest_rad, solved.moved_rad);
  RowCells cells;
  for (const double p : solved.command.p) cells.add(show::to_mm(p));
  for (const double q : solved.command.q) cells.add(q);
  cells.add(to_string(status));
  columns.append(targets.table.raw_rows.view(static_cast<std::size_t>(row)), cells.cells(), text);
}

}  // namespace plumb::offline::cli
