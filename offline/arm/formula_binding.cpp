// SPDX-License-Identifier: Apache-2.0
#include "arm/formula_binding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cell/formula_reader.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {
namespace {

using format::ContextInput;
using format::FormulaOp;

class FormulaBinder {
 public:
  FormulaBinder(const Cell& cell, const Measurements& measured, const EffectEntry& entry)
      : cell_(cell), context_(measured.context), entry_(entry) {}

  format::Effect bind() {
    FormulaProblems problems;
    const FormulaText text = formula_text(entry_);
    compiled_ = compile_formula(text, formula_arm(cell_.nominal), problems);
    if (!problems.empty()) refuse(": " + problems.front().message, "plumb check shows where");
    out_.name = formula_effect();
    out_.formula = compiled_.formula;
    for (const auto& p : out_.formula.parameters) out_.parameters.push_back(p.start);
    directions();
    payload_and_time();
    for (const auto& sensor : compiled_.sensors) temperature(sensor);
    return std::move(out_);
  }

 private:
  [[noreturn]] void refuse(const std::string& why, const std::string& help) const {
    throw Failure(Exit::kInput, {.code = "E-EFFECT-DATA",
                                 .message = fmt::format("formula '{}'{}",
                                                        formula_label(formula_text(entry_)), why),
                                 .place = entry_.place,
                                 .help = help});
  }

  void directions() {
    const auto moves = compiled_.joints_read(FormulaOp::kDirection);
    const auto travels = compiled_.joints_read(FormulaOp::kTravel);
    std::set_union(moves.begin(), moves.end(), travels.begin(), travels.end(),
                   std::back_inserter(out_.joints));
    const char* const from_order =
        "if the rows are consecutive moves: plumb import --dir from-order";
    if (!moves.empty() && context_.direction.rows() == 0)
      refuse(" needs columns dir_j1 …", from_order);
    if (!travels.empty() && context_.travel.rows() == 0)
      refuse(" needs columns travel_j1_deg …", from_order);
    if (!moves.empty()) out_.context.push_back({ContextInput::kDirection, "", 0.0});
    if (!travels.empty()) out_.context.push_back({ContextInput::kTravel, "", 0.0});
  }

  void payload_and_time() {
    if (compiled_.reads(FormulaOp::kPayload))
      out_.context.push_back({ContextInput::kPayload, "", cell_.payload.mass_kg});
    if (!compiled_.reads(FormulaOp::kTime)) return;
    if (context_.time_s.size() == 0) refuse(" needs the time of each row", "add a column t_s");
    out_.context.push_back({ContextInput::kTime, "", mean(context_.time_s)});
  }

  void temperature(const std::string& sensor) {
    const auto& all = context_.sensors;
    const auto at = std::find(all.begin(), all.end(), sensor);
    if (at == all.end())
      refuse(fmt::format(" needs column {}_degC", sensor),
             all.empty() ? "measure it, or leave it out"
                         : fmt::format("these files have: {}", fmt::join(all, ", ")));
    out_.context.push_back(
        {ContextInput::kTemperature, sensor, mean(context_.temperature.col(at - all.begin()))});
  }

  static double mean(const Eigen::VectorXd& values) {
    double sum = 0.0, count = 0.0;
    for (double v : values)
      if (std::isfinite(v)) sum += v, count += 1.0;
    return count > 0.0 ? sum / count : 0.0;
  }

  const Cell& cell_;
  const ContextRows& context_;
  const EffectEntry& entry_;
  CompiledFormula compiled_;
  format::Effect out_;
};

}  // namespace

format::Effect bind_formula(const Cell& cell, const Measurements& measured,
                            const EffectEntry& entry) {
  return FormulaBinder(cell, measured, entry).bind();
}

}  // namespace plumb::offline
