// SPDX-License-Identifier: Apache-2.0
#include "recheck/refit.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "arm/arm_change.hpp"
#include "fit/calibrate.hpp"
#include "program/problem.hpp"
#include "solve/series_numbers.hpp"

namespace plumb::offline::recheck {
namespace {

using Kind = Parameter::Kind;

constexpr Eigen::Index kNone = -1;

Eigen::Index place_of(const std::vector<Parameter>& all, const std::string& name) {
  const auto at =
      std::find_if(all.begin(), all.end(), [&](const Parameter& p) { return p.name == name; });
  return at == all.end() ? kNone : at - all.begin();
}

/// Takes the amplitudes of series of waves out, which a run does not list.
void drop_series(const ArmState& state, std::vector<Parameter>& all, Eigen::MatrixXd& covariance) {
  std::vector<Eigen::Index> kept;
  std::vector<Parameter> listed;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (is_amplitude_of_series(state.arm, all[i])) continue;
    kept.push_back(static_cast<Eigen::Index>(i));
    listed.push_back(all[i]);
  }
  covariance = covariance(kept, kept).eval();
  all = std::move(listed);
}

/// Removes effects that were added for a change that was not found.
void drop_unused_effects(std::size_t of_run, const std::vector<Parameter>& used, ArmState& state,
                         std::vector<Parameter>& all) {
  auto& effects = state.arm.effects;
  for (std::size_t place = effects.size(); place-- > of_run;) {
    const auto uses = [&](const Parameter& p) {
      return p.of_effect() && p.joint == static_cast<int>(place);
    };
    if (std::any_of(used.begin(), used.end(), uses)) continue;
    effects.erase(effects.begin() + static_cast<std::ptrdiff_t>(place));
    for (auto& p : all)
      if (p.of_effect() && p.joint > static_cast<int>(place)) --p.joint;
  }
}

}  // namespace

LastSetup last_setup(const Run& run) {
  const Calibration& c = run.fit.calibration;
  const int count = static_cast<int>(c.estimates.size());
  if (static_cast<int>(c.parameters.size()) != count)
    throw Failure(Exit::kInput,
                  {.code = "E-RECHECK-RUN",
                   .message = fmt::format("cell.toml no longer has all numbers that run {} fitted",
                                          run.number),
                   .help = "fit again: plumb fit"});
  const int last = c.state.setups() - 1;
  LastSetup out;
  out.state = c.state;
  out.state.X_MB = c.state.frame(last);
  out.state.X_TG = c.state.target(last);
  out.state.more.clear();
  std::vector<Eigen::Index> kept;
  for (int i = 0; i < count; ++i) {
    Parameter p = c.parameters[static_cast<std::size_t>(i)];
    const bool frame = p.of_base();
    if (!p.of_robot()) {
      if (p.setup != (frame ? c.state.frame_of(last) : c.state.target_of(last))) continue;
      p.setup = 0;
      if (const auto dot = p.name.rfind('.'); dot != std::string::npos)
        p.name = (frame ? "frame" : "target") + p.name.substr(dot);
    }
    out.known.parameters.push_back(std::move(p));
    kept.push_back(i);
  }
  out.known.covariance = c.covariance(kept, kept);
  return out;
}

Calibration refitted(const Cell& cell, const Calibration& parent, const LastSetup& before,
                     const std::vector<Change>& changes, const Judged& judged) {
  std::vector<Parameter> all = before.known.parameters, changed;
  for (const auto& change : changes)
    for (const auto& p : change.parameters) {
      changed.push_back(p);
      if (place_of(all, p.name) == kNone) all.push_back(p);
    }
  const auto old = static_cast<Eigen::Index>(before.known.parameters.size());
  const auto count = static_cast<Eigen::Index>(all.size());

  // The errors of the old numbers propagate as (I - G J), with G the gain of the numbers that were
  // refitted.
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(count, judged.r.size());
  for (std::size_t c = 0; c < changes.size(); ++c)
    for (std::size_t k = 0; k < changes[c].parameters.size(); ++k)
      G.row(place_of(all, changes[c].parameters[k].name)) =
          judged.gain.row(judged.begin[c] + static_cast<Eigen::Index>(k));
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(count, old);
  A -= G * judged.J;
  Calibration out = parent;
  out.covariance = A * before.known.covariance * A.transpose() + G * judged.E * G.transpose();
  out.state = judged.state;
  drop_series(out.state, all, out.covariance);
  out.parameters = std::move(all);
  drop_unused_effects(before.state.arm.effects.size(), changed, out.state, out.parameters);
  ArmState nominal = out.state;
  nominal.arm.calibrated = cell.nominal;
  for (auto& effect : nominal.arm.effects)
    std::fill(effect.parameters.begin(), effect.parameters.end(), 0.0);
  out.estimates = offline::estimates_of(out.state, nominal, out.parameters, out.covariance);
  out.outliers.clear();
  out.remarks.clear();
  return out;
}

std::vector<Estimate> estimates_of(const Change& change, const ArmState& state,
                                   const Eigen::VectorXd& std) {
  const Eigen::MatrixXd variance = std.array().square().matrix().asDiagonal();
  return offline::estimates_of(state, state, change.parameters, variance);
}

}  // namespace plumb::offline::recheck
