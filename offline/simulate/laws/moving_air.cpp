// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <numbers>

#include "simulate/joint_law.hpp"
#include "simulate/law_list.hpp"

namespace plumb::offline::sim {
namespace {

constexpr double kUsualAir_m = 40e-6;
constexpr double kAirRange_m = 4.0;  // R
constexpr double kFastest_s = 180.0, kSlowest_s = 3600.0;
constexpr int kWaves = 16;
constexpr double kLevelShare = 0.6, kRangeShare = 0.25;  // of the amplitude in elevation

/// A random function of time of about unit variance with most of it in its slow part: a sum of
/// waves of random periods whose squared amplitudes are proportional to the period.
class SlowNoise {
 public:
  explicit SlowNoise(Random random) {
    double sum = 0.0;
    for (auto& wave : waves_) {
      const double period = std::exp(random.uniform(std::log(kFastest_s), std::log(kSlowest_s)));
      wave = {2.0 * std::numbers::pi / period, random.uniform(-std::numbers::pi, std::numbers::pi),
              std::sqrt(period)};
      sum += 0.5 * period;
    }
    for (auto& wave : waves_) wave.amplitude /= std::sqrt(sum);
  }
  double at(double time_s) const {
    double out = 0.0;
    for (const auto& wave : waves_)
      out += wave.amplitude * std::sin(wave.rate * time_s + wave.phase);
    return out;
  }

 private:
  struct Wave {
    double rate = 0.0, phase = 0.0, amplitude = 0.0;
  };
  std::array<Wave, kWaves> waves_;
};

}  // namespace

// Air of another temperature moves through the beam of the tracker within minutes. It bends the
// beam, up and down more than to the sides, and lengthens the light's way:
//   shift = size (r / R)^2 (e(t) up + 0.6 a(t) level) + size (r / R) 0.25 d(t) along the beam
// e, a, d: independent slow random functions of time; r: distance; R = 4 m.
MadeLaw make_moving_air(const HiddenEffect& effect, const World& world) {
  const double size = effect.size.value_or(kUsualAir_m);
  const SlowNoise up(Random(world.seed, "air up")), level(Random(world.seed, "air level")),
      along(Random(world.seed, "air along"));
  const Isometry3d X_MB = world.X_MB, X_TG = world.X_TG;
  ArmBending out;
  out.bend = [=](const Moment& now, Deflection& deflection) {
    const Vector3d p_M = X_MB * (now.frames.tool * X_TG.translation());
    const Vector3d beam = p_M.normalized();
    const Vector3d side = Vector3d::UnitZ().cross(beam).normalized();
    const double far = p_M.norm() / kAirRange_m;
    const double t = now.visit.time_s;
    const Vector3d shift_M =
        size * far *
        (far * (up.at(t) * beam.cross(side) + kLevelShare * level.at(t) * side) +
         kRangeShare * along.at(t) * beam);
    deflection.tip_B += X_MB.linear().transpose() * shift_M;
  };
  out.truth = {{"elevation_um_at_4_m", size * 1e6},
               {"level_share", kLevelShare},
               {"range_share", kRangeShare},
               {"fastest_s", kFastest_s},
               {"slowest_s", kSlowest_s}};
  out.inputs = {"t", "order"};
  return arm_law(std::move(out));
}

}  // namespace plumb::offline::sim
