// SPDX-License-Identifier: Apache-2.0
#include "arm/context_needs.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "arm/effect_binding.hpp"
#include "effects/registry.hpp"
#include "plumb/format/formula.hpp"

namespace plumb::offline {
namespace {

using format::ContextInput;
using format::FormulaOp;
using WantKind = ContextWant::Kind;

std::string numbered(const char* prefix, std::size_t joint) {
  return prefix + std::to_string(joint + 1);
}

/// The different operands of an operation in the code of a formula.
std::vector<std::size_t> operands(const format::Formula& formula, FormulaOp op) {
  std::vector<std::size_t> out;
  for (const auto code : formula.code)
    if (format::operation(code) == op) out.push_back(format::operand(code));
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

bool formula_reads(const format::Effect& effect, FormulaOp op) {
  return !operands(effect.formula, op).empty();
}

unsigned needs_of(const format::Effect& effect) {
  const EffectDescriptor* const found = find_descriptor(effect.name);
  return found == nullptr || found->law == nullptr ? 0U : found->law->needs;
}

bool reads_load(const format::Effect& effect) {
  return (needs_of(effect) & (kNeedsPayload | kNeedsMasses)) != 0 ||
         formula_reads(effect, FormulaOp::kPayload) || formula_reads(effect, FormulaOp::kTorque);
}

bool reads_wrench(const format::Effect& effect) {
  return (needs_of(effect) & (kNeedsWrench | kNeedsMasses)) != 0 ||
         formula_reads(effect, FormulaOp::kTorque);
}

/// Collects the inputs of the effects of a model.
class WantCollector {
 public:
  WantCollector(const format::Model& model, std::vector<ContextWant>& out)
      : out_(out), sensors_(temperature_names(model)), load_varied_(varied(model)) {}

  void add(const format::Effect& effect) {
    name_ = effect.formula.code.empty() ? effect.name : effect.formula.name;
    if (effect.formula.code.empty())
      of_law(effect);
    else
      of_formula(effect);
    for (const auto& need : effect.context)
      if (need.input == ContextInput::kTemperature) temperature(need);
    if (reads_load(effect) && load_varied_) want(WantKind::kLoad, "payload_kg", 0);
  }

 private:
  static bool varied(const format::Model& model) {
    const auto& ranges = model.domain.context;
    return std::any_of(ranges.begin(), ranges.end(), [](const auto& r) {
      return r.input == ContextInput::kPayload && r.name.empty() && r.low < r.high;
    });
  }

  void want(WantKind kind, std::string column, std::size_t index, double fallback = 0.0) {
    out_.push_back({kind, name_, std::move(column), index, fallback});
  }

  void of_law(const format::Effect& effect) {
    const unsigned needs = needs_of(effect);
    for (const std::size_t j : effect.joints) {
      if ((needs & kNeedsDirection) != 0) want(WantKind::kDirection, numbered("dir_j", j), j);
      if ((needs & kNeedsSteps) != 0) want(WantKind::kMove, numbered("travel_j", j), j);
    }
    if ((needs & kNeedsOrder) != 0) want(WantKind::kPlaceInSeries, "t_s", 0);
    if ((needs & kNeedsTime) != 0) want(WantKind::kPlaceInSeries, "t_s", 0);
  }

  void of_formula(const format::Effect& effect) {
    for (const std::size_t j : operands(effect.formula, FormulaOp::kDirection))
      want(WantKind::kDirection, numbered("dir_j", j), j);
    for (const std::size_t j : operands(effect.formula, FormulaOp::kMove))
      want(WantKind::kMove, numbered("travel_j", j), j);
    if (formula_reads(effect, FormulaOp::kRow)) want(WantKind::kPlaceInSeries, "t_s", 0);
    for (const auto& need : effect.context)
      if (need.input == ContextInput::kTime) want(WantKind::kMoment, "t_s", 0, need.fallback);
  }

  void temperature(const format::ContextNeed& need) {
    const auto at = std::find(sensors_.begin(), sensors_.end(), need.name);
    if (at == sensors_.end()) return;
    want(WantKind::kWarmth, need.name + "_degC", static_cast<std::size_t>(at - sensors_.begin()),
         need.fallback);
  }

  std::vector<ContextWant>& out_;
  std::vector<std::string> sensors_;
  bool load_varied_;
  std::string name_;
};

/// Range of the values, with `where_unknown` in place of NaN; nothing if none is known.
template <class Values>
std::optional<format::ContextRange> range_of(ContextInput input, std::string name,
                                             const Values& values, double where_unknown) {
  format::ContextRange out{input, std::move(name), HUGE_VAL, -HUGE_VAL};
  for (double v : values) {
    if (std::isnan(v)) v = where_unknown;
    if (std::isnan(v)) continue;
    out.low = std::min(out.low, v);
    out.high = std::max(out.high, v);
  }
  if (!(out.low <= out.high)) return std::nullopt;
  return out;
}

void add_loads(const format::Mechanics& own, const ContextRows& rows,
               std::vector<format::ContextRange>& out) {
  const char* const names[] = {"", "cx", "cy", "cz"};
  for (int k = 0; k < 4; ++k) {
    const double usual =
        k == 0 ? own.payload_kg : own.payload_com_m[static_cast<std::size_t>(k) - 1];
    const Eigen::VectorXd values = rows.payload.rows() > 0 ? Eigen::VectorXd(rows.payload.col(k))
                                                           : Eigen::VectorXd::Constant(1, usual);
    out.push_back(*range_of(ContextInput::kPayload, names[k], values, usual));
  }
}

void add_wrench(const ContextRows& rows, std::vector<format::ContextRange>& out) {
  const char* const names[] = {"fx", "fy", "fz", "mx", "my", "mz"};
  for (int k = 0; k < 6; ++k) {
    const Eigen::VectorXd values =
        rows.wrench.rows() > 0 ? Eigen::VectorXd(rows.wrench.col(k)) : Eigen::VectorXd::Zero(1);
    out.push_back(*range_of(ContextInput::kPayload, names[k], values, 0.0));
  }
}

}  // namespace

std::vector<ContextWant> context_wants(const format::Model& model) {
  std::vector<ContextWant> out;
  WantCollector wants(model, out);
  for (const auto& effect : model.effects) wants.add(effect);
  return out;
}

std::vector<format::ContextRange> trained_context(const format::Model& model,
                                                  const ContextRows& rows) {
  std::vector<format::ContextRange> out;
  const auto& effects = model.effects;
  if (std::any_of(effects.begin(), effects.end(), reads_load))
    add_loads(model.mechanics, rows, out);
  if (std::any_of(effects.begin(), effects.end(), reads_wrench)) add_wrench(rows, out);
  for (const auto& name : temperature_names(model)) {
    const auto at = std::find(rows.sensors.begin(), rows.sensors.end(), name);
    if (at == rows.sensors.end()) continue;
    const Eigen::VectorXd values = rows.temperature.col(at - rows.sensors.begin());
    if (const auto range = range_of(ContextInput::kTemperature, name, values, kUnknown))
      out.push_back(*range);
  }
  return out;
}

std::vector<format::ContextRange> ranges_read(const format::Model& model,
                                              const std::vector<format::ContextRange>& ranges) {
  const auto& effects = model.effects;
  const bool load = std::any_of(effects.begin(), effects.end(), reads_load);
  const bool wrench = std::any_of(effects.begin(), effects.end(), reads_wrench);
  const auto sensors = temperature_names(model);
  std::vector<format::ContextRange> out;
  for (const auto& r : ranges) {
    const bool is_load = r.name.empty() || r.name[0] == 'c';
    const bool read = r.input == ContextInput::kTemperature
                          ? std::find(sensors.begin(), sensors.end(), r.name) != sensors.end()
                          : (is_load ? load : wrench);
    if (read) out.push_back(r);
  }
  return out;
}

}  // namespace plumb::offline
