// SPDX-License-Identifier: Apache-2.0
#include "arm/known_inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plumb::offline {
namespace {

using WantKind = ContextWant::Kind;

constexpr std::size_t kRangesListed = 4;

bool slides(const format::JointRow& row) { return row.type == format::JointType::kPrismatic; }

/// "120", "-0.25": at most four digits.
std::string shown(double value) { return fmt::format("{:.4g}", value); }

std::string shown(double value, const format::JointRow& row) {
  return slides(row) ? fmt::format("{:.1f}", value * 1e3)
                     : fmt::format("{:.1f}", value * 180.0 / std::numbers::pi);
}

struct RangeLabel {
  std::string name, unit;
  double scale;  // from SI
};

RangeLabel label_of(const format::ContextRange& range) {
  if (range.input == format::ContextInput::kTemperature) return {range.name, "degC", 1.0};
  if (range.name.empty()) return {"payload", "kg", 1.0};
  if (range.name[0] == 'c') return {"payload_" + range.name, "mm", 1e3};
  return {range.name, range.name[0] == 'f' ? "N" : "Nm", 1.0};
}

bool needs_place(const ContextWant& want) {
  return want.kind == WantKind::kPlaceInSeries || want.kind == WantKind::kMoment;
}

}  // namespace

KnownInputs::KnownInputs(const format::Model& model)
    : known_(model),
      domain_(model.domain),
      joints_(model.calibrated.joints),
      payload_kg_(model.mechanics.payload_kg),
      joint_beyond_(model.domain.q_min.size()),
      context_beyond_(model.domain.context.size()) {
  for (auto& want : context_wants(model)) lacks_.push_back({std::move(want), 0});
}

Status KnownInputs::mark(std::span<const double> q, const MeasuredContext& at, bool placed,
                         Status said) {
  ++rows_;
  bool lacking = false;
  for (auto& lack : lacks_) {
    if (!lacks(lack.want, at, placed)) continue;
    ++lack.rows;
    lacking = true;
  }
  const bool outside = known_.look(q, at.known).outside;
  if (outside) look_beyond(q, at.known);
  if (refused(said)) return said;
  if (outside) return Status::kOutsideDomain;
  return lacking && said == Status::kOk ? Status::kContextFallback : said;
}

bool KnownInputs::lacks(const ContextWant& want, const MeasuredContext& at, bool placed) const {
  switch (want.kind) {
    case WantKind::kDirection:
      return std::isnan(at.known.direction[want.index]);
    case WantKind::kMove:
      return std::isnan(at.step[want.index]);
    case WantKind::kPlaceInSeries:
      return !placed;
    case WantKind::kMoment:
      return !placed || std::isnan(at.known.time_s);
    case WantKind::kWarmth:
      return std::isnan(at.known.temperature_degC[want.index]);
    default:
      return std::isnan(at.known.payload_kg);
  }
}

void KnownInputs::look_beyond(std::span<const double> q, const Context& at) {
  ++outside_;
  for (std::size_t j = 0; j < std::min(joint_beyond_.size(), q.size()); ++j)
    if (known_.joint_outside(j, q[j]))
      note(q[j], domain_.q_min[j], domain_.q_max[j], joint_beyond_[j]);
  for (std::size_t k = 0; k < context_beyond_.size(); ++k)
    if (known_.context_outside(k, at))
      note(known_.value(k, at), domain_.context[k].low, domain_.context[k].high,
           context_beyond_[k]);
}

void KnownInputs::note(double value, double low, double high, OutsideRange& out) const {
  ++out.rows;
  const double far = std::abs(value - 0.5 * (low + high));
  if (far < out.farthest) return;
  out.farthest = far;
  out.value = value;
}

int KnownInputs::without_place() const {
  int most = 0;
  for (const auto& lack : lacks_)
    if (needs_place(lack.want)) most = std::max(most, lack.rows);
  return most;
}

void KnownInputs::add(const KnownInputs& more) {
  rows_ += more.rows_;
  outside_ += more.outside_;
  for (std::size_t k = 0; k < lacks_.size(); ++k) lacks_[k].rows += more.lacks_[k].rows;
  add(more.joint_beyond_, joint_beyond_);
  add(more.context_beyond_, context_beyond_);
}

void KnownInputs::add(const std::vector<OutsideRange>& more, std::vector<OutsideRange>& out) {
  for (std::size_t k = 0; k < out.size(); ++k) {
    out[k].rows += more[k].rows;
    if (more[k].farthest < out[k].farthest) continue;
    out[k].farthest = more[k].farthest;
    out[k].value = more[k].value;
  }
}

std::vector<Problem> KnownInputs::remarks() const {
  std::vector<Problem> out;
  const bool lacking = std::any_of(lacks_.begin(), lacks_.end(),
                                   [](const LackingInput& lack) { return lack.rows > 0; });
  if (lacking) out.push_back(of_lacks());
  if (outside_ > 0) out.push_back(of_outside());
  return out;
}

std::string KnownInputs::assumed(const ContextWant& want) const {
  switch (want.kind) {
    case WantKind::kDirection:
      return "no error of the way it came";
    case WantKind::kMove:
      return "it stood still before it was read";
    case WantKind::kPlaceInSeries:
      return "as right after the last row of the cell's own measurements";
    case WantKind::kMoment:
      return fmt::format("{} s", shown(want.fallback));
    case WantKind::kWarmth:
      return shown(want.fallback) + " degC";
    default:
      return shown(payload_kg_) + " kg";
  }
}

/// Names each effect once, with the first column it lacks and the value that replaces it.
Problem KnownInputs::of_lacks() const {
  std::vector<std::string> said, columns, effects;
  for (const auto& [want, rows] : lacks_) {
    if (rows == 0) continue;
    if (std::find(columns.begin(), columns.end(), want.column) == columns.end())
      columns.push_back(want.column);
    if (std::find(effects.begin(), effects.end(), want.effect) != effects.end()) continue;
    effects.push_back(want.effect);
    said.push_back(
        fmt::format("{} of {} rows {} '{}', which effect '{}' needs (assumed: {})", rows, rows_,
                    needs_place(want) ? "have no place in the cell's own series by" : "do not say",
                    want.column, want.effect, assumed(want)));
  }
  const bool moves = std::any_of(lacks_.begin(), lacks_.end(), [](const LackingInput& lack) {
    return lack.rows > 0 && lack.want.kind == WantKind::kMove;
  });
  for (auto& column : columns) {
    if (column.starts_with("travel_j")) column += "_deg";
    if (column == "t_s") column = "t_s (or time, if the cell's own measurements have that)";
  }
  std::string help = fmt::format("add to the file: {}", fmt::join(columns, ", "));
  if (moves) help = "add to the file dir_jN and travel_jN_deg of every joint";
  return {.severity = Severity::kWarning,
          .code = "W-PREDICT-INPUT",
          .message = fmt::format("{}", fmt::join(said, "; ")),
          .help = help};
}

Problem KnownInputs::of_outside() const {
  std::vector<std::string> said;
  for (std::size_t j = 0; j < joint_beyond_.size() && j < joints_.size(); ++j) {
    if (joint_beyond_[j].rows == 0) continue;
    const auto& row = joints_[j];
    said.push_back(fmt::format("{} {} {} (fitted {} .. {})", row.name,
                               shown(joint_beyond_[j].value, row), slides(row) ? "mm" : "deg",
                               shown(domain_.q_min[j], row), shown(domain_.q_max[j], row)));
  }
  for (std::size_t k = 0; k < context_beyond_.size(); ++k) {
    if (context_beyond_[k].rows == 0) continue;
    const auto& range = domain_.context[k];
    const RangeLabel label = label_of(range);
    said.push_back(fmt::format("{} {} {} (fitted {} .. {})", label.name,
                               shown(context_beyond_[k].value * label.scale), label.unit,
                               shown(range.low * label.scale), shown(range.high * label.scale)));
  }
  if (said.size() > kRangesListed) {
    const std::string rest = fmt::format("{} more", said.size() - kRangesListed);
    said.resize(kRangesListed);
    said.push_back(rest);
  }
  return {.severity = Severity::kWarning,
          .code = "W-PREDICT-OUTSIDE",
          .message = fmt::format("{} of {} rows lie outside what the model was fitted with: {}",
                                 outside_, rows_, fmt::join(said, ", ")),
          .help = "check the units of these columns; if they are right, measure poses there too"};
}

}  // namespace plumb::offline
