// SPDX-License-Identifier: Apache-2.0
#include "tests/rt/laws/law_watch.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "tests/rt/wild.hpp"

namespace plumb::tests {
namespace {

constexpr double kRounding = 1e-12;
constexpr double kFarRounding = 0x1p-50;  // of the size of a target's position
constexpr int kLongestDecay = 5000;       // cycles
constexpr int kDecayEvery = 2000;
constexpr int kRepeatEvery = 8;
constexpr int kSwapEvery = 2000;

void require(bool holds, const char* law) {
  if (!holds) throw BrokenLaw(law);
}

bool finite(const Transformd& X) { return X.p.allFinite() && X.R.allFinite(); }

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool same_bits(const Transformd& a, const Transformd& b) {
  bool same = true;
  for (int i = 0; i < 3; ++i) {
    same = same && same_bits(a.p(i), b.p(i));
    for (int j = 0; j < 3; ++j) same = same && same_bits(a.R(i, j), b.R(i, j));
  }
  return same;
}

bool same_bits(const Correction& a, const Correction& b) {
  return same_bits(a.X_BC, b.X_BC) &&
         std::equal(a.q.begin(), a.q.end(), b.q.begin(),
                    [](double x, double y) { return same_bits(x, y); }) &&
         same_bits(a.residual_m, b.residual_m) && same_bits(a.residual_rad, b.residual_rad) &&
         a.steps == b.steps && a.status == b.status;
}

bool equal(const Transformd& a, const Transformd& b) { return a.p == b.p && a.R == b.R; }

}  // namespace

LawTally& LawTally::operator+=(const LawTally& other) {
  for (auto field : {&LawTally::cycles, &LawTally::lives, &LawTally::corrected, &LawTally::invented,
                     &LawTally::repeated, &LawTally::stale, &LawTally::swapped, &LawTally::held,
                     &LawTally::limited, &LawTally::decays})
    this->*field += other.*field;
  return *this;
}

LawWatch::LawWatch(std::uint64_t seed, Plant plant, LawTally& tally)
    : model_(random_arm_model(seed)),
      limits_(model_.guard),
      corrector_(model_),
      inputs_(corrector_, model_, seed),
      guard_(model_.guard, plant),
      tally_(tally) {
  ++tally_.lives;
}

void LawWatch::cycle() {
  Random& random = inputs_.random();
  inputs_.next(input_);
  if (one_in(random, 500))
    guard_.enable(one_in(random, 3) ? Guard::Enable::kOff : Guard::Enable::kOn);
  if (one_in(random, kSwapEvery)) swap();
  check_prediction(input_);
  const Correction correction = correction_for(input_);
  const GuardOutput out = guard_.step(input_.X_BD, correction, input_.dt_s, input_.age);
  check_output(input_, correction, out);
  ++tally_.cycles;
  tally_.limited += out.status == Status::kLimited ? 1 : 0;
  tally_.stale += out.status == Status::kStale ? 1 : 0;
  if (one_in(random, kDecayEvery))
    decay(one_in(random, 2) ? Guard::Inputs::kFresh : Guard::Inputs::kStale);
}

/// Another model of the same arm, of which the guard sees the limits.
void LawWatch::swap() {
  const auto corrects = limits_.corrects;
  limits_ = random_arm_model(inputs_.random().bits()).guard;
  limits_.corrects = corrects;
  guard_.swap(limits_);
  ++tally_.swapped;
}

void LawWatch::check_prediction(const CycleInput& input) const {
  const Prediction arm = corrector_.forward_model().predict(input.seed(), input.context);
  require(finite(arm.X_BT) && arm.tree_B.allFinite(), "a prediction is finite");
  if (refused(arm.status)) require(equal(arm.X_BT, Transformd{}), "what is refused is no pose");
}

Correction LawWatch::correction_for(const CycleInput& input) {
  const auto solve = [&] {
    return corrector_.solve(input.X_BD, input.seed(), input.kind, input.context);
  };
  const Correction out = solve();
  check_solved(input, out);
  tally_.corrected += refused(out.status) ? 0 : 1;
  if (one_in(inputs_.random(), kRepeatEvery)) {
    ++tally_.repeated;
    require(same_bits(guard_.spoiled(solve()), out), "solve() gives the same bits again");
  }
  tally_.invented += input.invents ? 1 : 0;
  return input.invents ? input.invented : out;
}

void LawWatch::check_solved(const CycleInput& input, const Correction& correction) {
  require(finite(correction.X_BC), "a correction is finite");
  steps_ = std::max(steps_, correction.steps);
  require(correction.steps == steps_, "solve() always takes the same steps");
  if (!input.sound_target) return require(refused(correction.status), "no target is refused");
  if (refused(correction.status))
    return require(same_bits(correction.X_BC, input.X_BD), "a refusal gives the target itself");
  require(correction.residual_m <= Corrector::kMaxResidual_m &&
              correction.residual_rad <= Corrector::kMaxResidual_rad,
          "what is not refused has converged");
  for (std::size_t i = 0; i < model_.nominal.joints.size(); ++i) {
    const bool turns = model_.nominal.joints[i].type == format::JointType::kRevolute;
    const double unit = turns ? 1.0 : model_.guard.length_scale_m;
    require(std::abs(correction.q[i] - input.q[i]) <= model_.guard.max_seed_distance * unit,
            "what is not refused is near its seed");
  }
}

void LawWatch::check_output(const CycleInput& input, const Correction& correction,
                            const GuardOutput& out) {
  require(finite(out.X_BC), "an output is finite");
  if (!input.sound_target) return check_held(out);
  if (input.age == Guard::Inputs::kStale)
    require(out.status == Status::kStale, "stale inputs are said to be");
  else if (refused(correction.status))
    require(out.status == correction.status, "a refusal is passed on");
  valid_ = valid_ || !refused(out.status);
  require(out.has_output == valid_, "no output before the first valid cycle, then always");
  const Added now = added(out.X_BC, input.X_BD);
  check_bounds(now, elapsed(input.dt_s));
  before_ = now;
  if (valid_) last_ = out.X_BC;
}

void LawWatch::check_held(const GuardOutput& out) const {
  ++tally_.held;
  require(out.status == Status::kNotFinite, "no target is said to be none");
  require(out.has_output == valid_, "no output before the first valid cycle, then always");
  if (valid_) require(same_bits(out.X_BC, last_), "without a target the last output stands");
}

void LawWatch::check_bounds(const Added& now, double dt_s) const {
  const double slack = kRounding + now.slack_m;
  require(now.p.norm() <=
              std::max(limits_.max_correction_m, before_.p.norm() + before_.slack_m) + slack,
          "a correction is small");
  require((now.p - before_.p).norm() <= limits_.slew_m_per_s * dt_s + slack + before_.slack_m,
          "a correction is slow");
  const bool turns = limits_.corrects == format::Corrects::kPose;
  require(now.r.norm() <=
              (turns ? std::max(limits_.max_rotation_rad, before_.r.norm()) : 0.0) + kRounding,
          "a correction turns little, or not at all");
  require((now.r - before_.r).norm() <= limits_.slew_rad_per_s * dt_s + kRounding,
          "a correction turns slowly");
}

double LawWatch::elapsed(double dt_s) const {
  return dt_s > 0.0 ? std::min(dt_s, 2.0 * limits_.cycle_s) : 0.0;
}

LawWatch::Added LawWatch::added(const Transformd& X_BC, const Transformd& X_BD) {
  const Eigen::AngleAxisd turn(Matrix3(X_BC.R * X_BD.R.transpose()));
  return {X_BC.p - X_BD.p, turn.angle() * turn.axis(),
          kFarRounding * X_BD.p.lpNorm<Eigen::Infinity>()};
}

/// From the largest correction at the slew limits, behind the ramp if that is what takes it down,
/// and two for rounding.
int LawWatch::cycles_to_decay(Guard::Inputs age) const {
  const format::GuardLimits& g = limits_;
  const double largest_m = std::max(g.max_correction_m, before_.p.norm());
  const double largest_rad = std::max(g.max_rotation_rad, before_.r.norm());
  const double seconds = std::max(largest_m / g.slew_m_per_s, largest_rad / g.slew_rad_per_s);
  const double ramp = age == Guard::Inputs::kStale ? g.ramp_s : 0.0;
  return static_cast<int>(std::min((seconds + ramp) / g.cycle_s, 1e6)) + 2;
}

void LawWatch::decay(Guard::Inputs age) {
  const int cycles = cycles_to_decay(age);
  if (cycles > kLongestDecay) return;
  const Status status = age == Guard::Inputs::kStale ? Status::kOk : Status::kNearSingular;
  GuardOutput out;
  Transformd X_BD;
  for (int k = 0; k < cycles; ++k) {
    X_BD = inputs_.sound_target();
    const Correction given{.X_BC = sound_pose(inputs_.random()), .status = status};
    out = guard_.step(X_BD, given, limits_.cycle_s, age);
    require(finite(out.X_BC), "an output is finite");
  }
  require(equal(out.X_BC, X_BD), "refusals and stale inputs leave exactly the target");
  before_ = {};
  if (valid_) last_ = out.X_BC;
  ++tally_.decays;
}

}  // namespace plumb::tests
