// SPDX-License-Identifier: Apache-2.0
#include "figures/formula_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "arm/effect_binding.hpp"
#include "arm/fitted_effects.hpp"
#include "arm/predicted_points.hpp"
#include "figures/joint_residual.hpp"
#include "noise/series.hpp"
#include "plumb/format/formula.hpp"
#include "plumb/runtime/chain.hpp"
#include "solve/outlier.hpp"

namespace plumb::offline::figures {
namespace {

using format::FormulaOp;
using format::FormulaTarget;

constexpr double kScaled = 1e-9;      // of an input, which may be larger than any motion is allowed
constexpr double kLever = 1e-3;       // [rad] or [m]
constexpr double kLeastLever = 1e-6;  // [m/rad] or [m/m]
constexpr double kNumberStep = 0.05;  // of the standard deviation of a number
constexpr std::size_t kInputSteps = 9;  // by which inputs are compared

/// An input that a formula reads, in the words and the unit of an axis.
struct FormulaInput {
  std::uint16_t code = 0;
  std::string name, unit;
  double per_si = 1.0;
};

FormulaInput input_of(std::uint16_t code, const RunResults& results,
                      const std::vector<std::string>& sensors) {
  const auto which = static_cast<std::size_t>(format::operand(code));
  const auto& joints = results.cell.nominal.joints;
  const bool slides = which < joints.size() && joints[which].type == format::JointType::kPrismatic;
  const std::string joint = which < joints.size() ? joints[which].name : "";
  switch (format::operation(code)) {
    case FormulaOp::kPosition:
      return {code, "position of " + joint, slides ? "mm" : "deg",
              slides ? 1e3 : 180.0 / std::numbers::pi};
    case FormulaOp::kTorque:
      return {code, fmt::format("{} of gravity on {}", slides ? "force" : "torque", joint),
              slides ? "N" : "N m"};
    case FormulaOp::kDirection:
      return {code, "side from which " + joint + " came", "-1 .. 1"};
    case FormulaOp::kTravel:
      return {code, "last travel of " + joint, slides ? "mm" : "deg",
              slides ? 1e3 : 180.0 / std::numbers::pi};
    case FormulaOp::kMove:
      return {code, "last move of " + joint, "share of the largest"};
    case FormulaOp::kTime:
      return {code, "time", "min", 1.0 / 60.0};
    case FormulaOp::kTemperature:
      return {code, which < sensors.size() ? sensors[which] : "temperature", "degC"};
    case FormulaOp::kPayload:
      return {code, "payload", "kg"};
    case FormulaOp::kTip:
      return {code, fmt::format("{} of the tool point", "xyz"[which % 3]), "mm", 1e3};
    default:
      return {code, "row", "number"};
  }
}

bool is_input(std::uint16_t code) {
  const FormulaOp op = format::operation(code);
  return format::taken(op) == 0 && op != FormulaOp::kLiteral && op != FormulaOp::kParameter;
}

/// The formula `effect` with other code, which has no parameters.
format::Effect with_code(format::Effect effect, std::vector<std::uint16_t> code,
                         std::vector<double> literals) {
  effect.formula.code = std::move(code);
  effect.formula.literals = std::move(literals);
  effect.formula.parameters.clear();
  effect.parameters.clear();
  return effect;
}

/// The formula as one that moves the first joint: the motion of that joint is the value of the
/// formula.
format::Effect as_value(format::Effect effect) {
  effect.formula.target = FormulaTarget::kJoint;
  effect.formula.joint = 0;
  effect.formula.component = 0;
  return effect;
}

bool shifts(const format::Formula& formula, const format::Chain& chain) {
  if (formula.target == FormulaTarget::kJoint)
    return chain.joints[formula.joint].type == format::JointType::kPrismatic;
  return formula.component < 3;
}

/// One formula, and what its inputs, its value and its unit motion are at a pose. All are laws of
/// one small model: the formula as a motion of a joint, the formula with a constant for its value,
/// and one for each input.
class Probe {
 public:
  Probe(const RunResults& results, int effect)
      : results_(results), effect_(effect), model_(results.run.fit.calibration.state.arm) {
    const format::Effect own = model_.effects[static_cast<std::size_t>(effect)];
    std::vector<std::string> names;
    for (const auto& need : own.context)
      if (need.input == format::ContextInput::kTemperature) names.push_back(need.name);
    std::set<std::uint16_t> codes;
    for (const auto code : own.formula.code)
      if (is_input(code)) codes.insert(code);
    model_.effects = {as_value(own),
                      with_code(own, {format::instruction(FormulaOp::kLiteral)}, {kLever})};
    for (const auto code : codes) {
      inputs_.push_back(input_of(code, results, names));
      model_.effects.push_back(as_value(with_code(own,
                                                  {code, format::instruction(FormulaOp::kLiteral),
                                                   format::instruction(FormulaOp::kMultiply)},
                                                  {kScaled})));
    }
    sensors_ = temperature_names(model_);
    laws_.emplace(model_);
    chain_.emplace(model_.calibrated);
    add_numbers();
  }

  const std::vector<FormulaInput>& inputs() const { return inputs_; }

  void go_to(int row) {
    const ArmState& state = results_.run.fit.calibration.state;
    const int setup = setup_of(results_.measured, row);
    const Transformd X_MB = from_pose(state.frame(setup));
    R_MB_ = X_MB.R;
    const auto& q = results_.measured.q;
    q_.assign(q.row(row).data(), q.row(row).data() + q.cols());
    context_ = context_of(results_.measured, row, sensors_, X_MB);
    chain_->frames(q_, frames_);
    laws_->survey(frames_, context_, around_);
    const auto& target = state.target(setup).p;
    p_B_ = frames_.tip * Vector3(target[0], target[1], target[2]);
  }

  double value() const { return value(model_.effects[0].parameters); }

  double sigma() const {
    auto theta = model_.effects[0].parameters;
    std::vector<double> slopes;
    for (const Number& number : numbers_) {
      const double before = theta[number.place];
      theta[number.place] = before + number.step;
      const double high = value(theta);
      theta[number.place] = before - number.step;
      slopes.push_back((high - value(theta)) / (2.0 * number.step));
      theta[number.place] = before;
    }
    const auto& covariance = results_.run.fit.calibration.covariance;
    double out = 0.0;
    for (std::size_t i = 0; i < slopes.size(); ++i)
      for (std::size_t k = 0; k < slopes.size(); ++k)
        out += slopes[i] * slopes[k] * covariance(numbers_[i].column, numbers_[k].column);
    return std::sqrt(std::max(0.0, out));
  }

  double input(std::size_t k) const {
    return inputs_[k].per_si * moved(static_cast<int>(k) + 2, {}).dq[0] / kScaled;
  }

  /// Motion of the measured point per unit of what the formula moves, measurement frame, along the
  /// measured axes.
  Eigen::Vector3d lever() const {
    const Motion<double> motion = moved(1, {});
    Vector3 out = motion.shift_B + cross<double>(motion.turn_B, p_B_ - frames_.tip.p);
    for (int j = 0; j < chain_->joints(); ++j) {
      const double dq = motion.dq[static_cast<std::size_t>(j)];
      if (dq == 0.0) continue;
      const Vector3 z = frames_.joint[j].R.col(2) * chain_->scale(j);
      out += dq * (chain_->revolute(j) ? Vector3(cross<double>(z, p_B_ - frames_.joint[j].p)) : z);
    }
    Eigen::Vector3d lever = R_MB_ * out / kLever;
    for (int k = 0; k < 3; ++k)
      if (!results_.measured.has_axis[static_cast<std::size_t>(k)]) lever(k) = 0.0;
    return lever;
  }

 private:
  struct Number {
    std::size_t place = 0;
    Eigen::Index column = 0;
    double step = 0.0;
  };

  Motion<double> moved(int law, const std::vector<double>& theta) const {
    Motion<double> out;
    laws_->apply_one<double>(law, theta, q_, *chain_, frames_, around_, out);
    if (out.undefined) out.dq[0] = NAN;
    return out;
  }

  double value(const std::vector<double>& theta) const { return moved(0, theta).dq[0]; }

  void add_numbers() {
    const auto fitted = fitted_parameters(results_.run);
    const auto& covariance = results_.run.fit.calibration.covariance;
    for (std::size_t i = 0; i < fitted.size(); ++i) {
      if (!fitted[i] || !fitted[i]->of_effect() || fitted[i]->joint != effect_) continue;
      const auto column = static_cast<Eigen::Index>(i);
      const double sigma = std::sqrt(std::max(0.0, covariance(column, column)));
      if (sigma > 0.0)
        numbers_.push_back(
            {static_cast<std::size_t>(fitted[i]->component), column, kNumberStep * sigma});
    }
  }

  const RunResults& results_;
  int effect_;
  format::Model model_;
  std::vector<std::string> sensors_;
  std::vector<FormulaInput> inputs_;
  std::vector<Number> numbers_;
  std::optional<FittedEffects> laws_;
  std::optional<Chain> chain_;
  std::vector<double> q_;
  MeasuredContext context_;
  ChainFrames frames_;
  FittedEffects::Surroundings around_;
  Matrix3 R_MB_ = Matrix3::Identity();
  Vector3 p_B_ = Vector3::Zero();
};

/// How much of the scatter of the law means over equal steps of the poses' order explain: 0 .. 1.
double followed(const std::vector<FormulaPoints::Pose>& by_input) {
  Scatter all, left;
  const std::size_t n = by_input.size();
  for (std::size_t k = 0; k < kInputSteps; ++k) {
    const std::size_t from = k * n / kInputSteps, to = (k + 1) * n / kInputSteps;
    double mean = 0.0;
    for (std::size_t i = from; i < to; ++i)
      mean += by_input[i].law / static_cast<double>(to - from);
    for (std::size_t i = from; i < to; ++i) {
      all.add(1.0, by_input[i].law);
      left.add(1.0, by_input[i].law - mean);
    }
  }
  return left.explained_of(all);
}

FormulaPoints points_of(const RunResults& results, int effect, const Series& visits,
                        const std::set<int>& held) {
  const ArmState& state = results.run.fit.calibration.state;
  const auto& formula = state.arm.effects[static_cast<std::size_t>(effect)].formula;
  Probe probe(results, effect);
  FormulaPoints out{.formula = formula.expression,
                    .input = "none: it is a constant",
                    .input_unit = "",
                    .inputs = probe.inputs().size(),
                    .turns = !shifts(formula, state.arm.calibrated)};
  std::vector<FormulaPoints::Pose> poses;
  std::vector<std::vector<double>> inputs;
  for (int i = 0; i < visits.size(); ++i) {
    const int row = visits.first_row[static_cast<std::size_t>(i)];
    probe.go_to(row);
    const Eigen::Vector3d m = probe.lever();
    const double law = probe.value();
    std::vector<double> at;
    for (std::size_t k = 0; k < probe.inputs().size(); ++k) at.push_back(probe.input(k));
    if (!(m.norm() > kLeastLever) || !std::isfinite(law) ||
        !std::all_of(at.begin(), at.end(), [](double x) { return std::isfinite(x); }))
      continue;
    const double rest = m.dot(visits.error_M.row(i)) / m.squaredNorm();
    poses.push_back({.row = row,
                     .value = rest + law,
                     .law = law,
                     .sigma = probe.sigma(),
                     .weight = m.squaredNorm(),
                     .held = held.contains(row)});
    inputs.push_back(std::move(at));
  }
  double most = -1.0;
  for (std::size_t k = 0; k < probe.inputs().size(); ++k) {
    for (std::size_t i = 0; i < poses.size(); ++i) poses[i].input = inputs[i][k];
    auto sorted = poses;
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const auto& a, const auto& b) { return a.input < b.input; });
    if (const double share = followed(sorted); share > most) {
      most = share;
      out.input = probe.inputs()[k].name;
      out.input_unit = probe.inputs()[k].unit;
      out.poses = std::move(sorted);
    }
  }
  if (probe.inputs().empty()) out.poses = std::move(poses);
  return out;
}

}  // namespace

bool has_formula(const RunResults& results) {
  const auto& effects = results.run.fit.calibration.state.arm.effects;
  return std::any_of(effects.begin(), effects.end(),
                     [](const format::Effect& effect) { return !effect.formula.code.empty(); });
}

std::vector<FormulaPoints> formula_points(const RunResults& results) {
  std::vector<FormulaPoints> out;
  std::vector<int> rows = results.held;
  rows.insert(rows.end(), results.fit.begin(), results.fit.end());
  std::sort(rows.begin(), rows.end());
  if (rows.empty()) return out;
  const Fit& fit = results.run.fit;
  rows = without_outliers(without_outliers(rows, fit.calibration.outliers), fit.held_outliers);
  const Series visits = series(results.measured, results.after_M, rows);
  const std::set<int> held(results.held.begin(), results.held.end());
  const auto& effects = fit.calibration.state.arm.effects;
  for (int i = 0; i < static_cast<int>(effects.size()); ++i)
    if (!effects[static_cast<std::size_t>(i)].formula.code.empty())
      out.push_back(points_of(results, i, visits, held));
  return out;
}

}  // namespace plumb::offline::figures
