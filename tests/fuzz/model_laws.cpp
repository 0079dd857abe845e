// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/model_laws.hpp"

#include <algorithm>
#include <bit>
#include <cinttypes>
#include <cmath>

#include "consistency.hpp"
#include "plumb/format/reader.hpp"
#include "plumb/format/writer.hpp"
#include "plumb/runtime/guard.hpp"
#include "tests/fuzz/require.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::tests {
namespace {

constexpr double kRounding = 1e-12;

LawTally tally;

bool finite(const Transformd& X) { return X.p.allFinite() && X.R.allFinite(); }

/// Within the joint's limits, on one of them, or anything a double can be.
double position(Random& random, const format::JointRow& row) {
  switch (random.below(8)) {
    case 0:
      return row.q_min;
    case 1:
      return row.q_max;
    case 2:
      return std::bit_cast<double>(random.bits());
    default:
      return random.uniform(row.q_min, row.q_max);
  }
}

/// Half of it unknown.
Context context(Random& random) {
  Context out;
  const auto fill = [&](auto& values, double size) {
    for (double& x : values)
      if (random.below(2) == 0) x = random.uniform(-size, size);
  };
  fill(out.direction, 1.0);
  fill(out.travel, 3.0);
  fill(out.temperature_degC, 80.0);
  fill(out.payload_com_m, 0.5);
  fill(out.force_N, 100.0);
  if (random.below(2) == 0) out.payload_kg = random.uniform(0.0, 100.0);
  if (random.below(2) == 0) out.time_s = random.uniform(0.0, 1e6);
  return out;
}

void require_bounded(const format::GuardLimits& limits, const Transformd& X_BD,
                     const GuardOutput& output) {
  require(finite(output.X_BC), "the guard's output is finite");
  if (!output.has_output) return;
  const double moved = (output.X_BC.p - X_BD.p).norm();
  const double rounding = kRounding * (1.0 + X_BD.p.norm());
  require(moved <= limits.max_correction_m + rounding, "the correction is within its limit");
  require(moved <= 2.0 * limits.slew_m_per_s * limits.cycle_s + rounding,
          "the correction is within its slew limit");
}

void require_sound_cycle(const format::Model& model, std::uint64_t seed) {
  const Corrector corrector(model);
  Random random(seed);
  std::array<double, kMaxJoints> q{};
  const std::size_t n = model.nominal.joints.size();
  for (std::size_t i = 0; i < n; ++i) q[i] = position(random, model.nominal.joints[i]);
  const auto joints = std::span<const double>(q).first(n);
  const Context known = context(random);
  const Prediction arm = corrector.forward_model().predict(joints, known);
  require(finite(arm.X_BT) && arm.tree_B.allFinite(), "the prediction is finite");
  const Correction correction = corrector.solve(arm.X_BT, joints, SeedKind::kCommanded, known);
  require(finite(correction.X_BC), "the correction is finite");
  require(refused(correction.status) || !refused(arm.status),
          "what cannot be predicted is refused");
  Guard guard(model.guard);
  require_bounded(model.guard, arm.X_BT, guard.step(arm.X_BT, correction, model.guard.cycle_s));
}

}  // namespace

LawTally::~LawTally() {
  std::fprintf(stderr, "%" PRIu64 " models let through, %" PRIu64 " of them run\n", read, cycles);
}

void require_written_and_read_back(const format::Model& model) {
  const auto again = format::read_model(format::write_model(model));
  const auto* same = std::get_if<format::Model>(&again);
  require(same != nullptr && *same == model, "what is read is written and read back the same");
}

void require_sound(const format::Model& model, std::uint64_t seed) {
  ++tally.read;
  const std::string wrong = format::inconsistency(model);
  require(wrong.empty(), wrong.c_str());
  if (find_effect_fault(model).kind != EffectFault::Kind::kNone) return;
  ++tally.cycles;
  require_sound_cycle(model, seed);
}

}  // namespace plumb::tests
