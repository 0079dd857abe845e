// SPDX-License-Identifier: Apache-2.0
#include "figures/joint_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "arm/effect_binding.hpp"
#include "arm/predicted_points.hpp"
#include "effects/registry.hpp"
#include "figures/words.hpp"

namespace plumb::offline::figures {
namespace {

constexpr std::size_t kProbes = 5;    // positions at which an effect is tried
constexpr double kMoves = 1e-12;      // [rad] or [m]: less is no motion
constexpr double kAlike = 1e-6;       // of the largest motion: less is no dependence
constexpr double kStep = 0.05;        // of the standard deviation of a number
constexpr double kLeastStep = 1e-12;  // of a difference, SI

}  // namespace

JointLaw::JointLaw(const RunResults& results, int joint, Of of)
    : results_(results),
      arm_(results.run.fit.calibration.state.arm),
      joint_(joint),
      chain_(arm_.calibrated),
      effects_(arm_),
      sensors_(temperature_names(arm_)),
      numbers_(fitted_parameters(results.run)) {
  const ArmState& state = results.run.fit.calibration.state;
  for (int k = 0; k < state.setups(); ++k) X_MB_.push_back(from_pose(state.frame(k)));
  std::vector<int> rows = results.held;
  rows.insert(rows.end(), results.fit.begin(), results.fit.end());
  std::sort(rows.begin(), rows.end());
  if (rows.empty() || effects_.empty()) return;
  std::vector<EvaluatedPose> probes(std::min(kProbes, rows.size()));
  for (std::size_t k = 0; k < probes.size(); ++k)
    put(rows[(2 * k + 1) * rows.size() / (2 * probes.size())], probes[k]);
  put(rows[rows.size() / 2], middle_);
  for (auto& place : probes) survey(place);
  for (int i = 0; i < effects_.size(); ++i) {
    double most = 0.0;
    for (const EvaluatedPose& place : probes) most = std::max(most, std::abs(moved(i, place)));
    if (most < kMoves) continue;
    const auto* known = find_descriptor(arm_.effects[static_cast<std::size_t>(i)].name);
    const bool own = is_own(i, probes);
    if (of == Of::kOwnPosition ? !own : own || known == nullptr || !grows_with_load(*known))
      continue;
    Term term{.effect = i, .numbers = {}};
    add_numbers(term, probes);
    terms_.push_back(std::move(term));
  }
}

void JointLaw::put(int row, EvaluatedPose& out) const {
  const auto setup = static_cast<std::size_t>(setup_of(results_.measured, row));
  const auto& q = results_.measured.q;
  out.q.assign(q.row(row).data(), q.row(row).data() + q.cols());
  out.context = context_of(results_.measured, row, sensors_, X_MB_[setup]);
}

void JointLaw::survey(EvaluatedPose& out) const {
  chain_.frames(out.q, out.frames);
  effects_.survey(out.frames, out.context, out.around);
}

double JointLaw::moved(int effect, const std::vector<double>& theta,
                       const EvaluatedPose& at) const {
  Motion<double> motion;
  effects_.apply_one<double>(effect, theta, at.q, chain_, at.frames, at.around, motion);
  const double out = motion.dq[static_cast<std::size_t>(joint_)];
  return std::isfinite(out) ? out : 0.0;
}

double JointLaw::moved(int effect, const EvaluatedPose& at) const {
  return moved(effect, arm_.effects[static_cast<std::size_t>(effect)].parameters, at);
}

bool JointLaw::is_own(int effect, const std::vector<EvaluatedPose>& probes) const {
  const auto j = static_cast<std::size_t>(joint_);
  for (const EvaluatedPose& where : probes) {
    double low = INFINITY, high = -INFINITY, most = 0.0;
    for (const EvaluatedPose& other : probes) {
      EvaluatedPose here = other;
      here.q[j] = where.q[j];
      here.context.known.direction[j] = where.context.known.direction[j];
      survey(here);
      const double value = moved(effect, here);
      low = std::min(low, value), high = std::max(high, value);
      most = std::max(most, std::abs(value));
    }
    if (high - low > std::max(kMoves, kAlike * most)) return false;
  }
  return true;
}

/// Those numbers of the effect that were fitted and move this joint.
void JointLaw::add_numbers(Term& term, const std::vector<EvaluatedPose>& probes) const {
  const Calibration& c = results_.run.fit.calibration;
  const auto& theta = arm_.effects[static_cast<std::size_t>(term.effect)].parameters;
  for (std::size_t i = 0; i < numbers_.size(); ++i) {
    if (!numbers_[i]) continue;
    const Parameter& parameter = *numbers_[i];
    const auto k = static_cast<Eigen::Index>(i);
    const auto place = static_cast<std::size_t>(parameter.component);
    if (!parameter.of_effect() || parameter.joint != term.effect || place >= theta.size()) continue;
    const double step = std::max(kLeastStep, kStep * std::sqrt(std::max(0.0, c.covariance(k, k))));
    auto other = theta;
    other[place] += step;
    const bool matters = std::any_of(probes.begin(), probes.end(), [&](const EvaluatedPose& at) {
      return moved(term.effect, other, at) != moved(term.effect, theta, at);
    });
    if (matters) term.numbers.push_back({place, k, step});
  }
}

double JointLaw::value(const EvaluatedPose& at) const {
  double out = 0.0;
  for (const Term& term : terms_) out += moved(term.effect, at);
  return out;
}

/// sqrt(g^T C g), g being the slope of the motion by each number.
double JointLaw::sigma(const EvaluatedPose& at) const {
  std::vector<Eigen::Index> columns;
  std::vector<double> slopes;
  for (const Term& term : terms_) {
    auto theta = arm_.effects[static_cast<std::size_t>(term.effect)].parameters;
    for (const Number& number : term.numbers) {
      const double before = theta[number.place];
      theta[number.place] = before + number.step;
      const double high = moved(term.effect, theta, at);
      theta[number.place] = before - number.step;
      const double low = moved(term.effect, theta, at);
      theta[number.place] = before;
      columns.push_back(number.column);
      slopes.push_back((high - low) / (2.0 * number.step));
    }
  }
  const auto& covariance = results_.run.fit.calibration.covariance;
  double out = 0.0;
  for (std::size_t i = 0; i < columns.size(); ++i)
    for (std::size_t k = 0; k < columns.size(); ++k)
      out += slopes[i] * slopes[k] * covariance(columns[i], columns[k]);
  return std::sqrt(std::max(0.0, out));
}

double JointLaw::at_pose(int row) const {
  if (empty()) return 0.0;
  EvaluatedPose here;
  put(row, here);
  survey(here);
  return value(here);
}

JointLaw::Value JointLaw::with_sigma(int row) const {
  if (empty()) return {};
  EvaluatedPose here;
  put(row, here);
  survey(here);
  return {value(here), sigma(here)};
}

JointLaw::Value JointLaw::at(double q, int side) const {
  if (empty()) return {};
  EvaluatedPose here = middle_;
  here.q[static_cast<std::size_t>(joint_)] = q;
  if (side != 0) here.context.known.direction[static_cast<std::size_t>(joint_)] = side;
  survey(here);
  return {value(here), sigma(here)};
}

bool JointLaw::has_sides() const {
  if (empty()) return false;
  EvaluatedPose up = middle_, down = middle_;
  up.context.known.direction[static_cast<std::size_t>(joint_)] = 1.0;
  down.context.known.direction[static_cast<std::size_t>(joint_)] = -1.0;
  survey(up), survey(down);
  return std::abs(value(up) - value(down)) > kMoves;
}

std::string JointLaw::names() const {
  std::vector<std::string> effects;
  for (const Term& term : terms_)
    effects.push_back(arm_.effects[static_cast<std::size_t>(term.effect)].name);
  return effect_names(effects, " and ");
}

}  // namespace plumb::offline::figures
