// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "simulate/law_list.hpp"

namespace plumb::offline::sim {
namespace {

constexpr double kHour_s = 3600.0;
constexpr double kLag_s = 1200.0;     // T
constexpr double kLagShare = 0.6;     // a
constexpr double kSwingShare = 0.05;  // b
constexpr double kUsualSize_m = 0.15e-3;

/// Base twist = (d, e) g(t),
/// g = a (1 - exp(-t/T)) / (1 - exp(-1 h/T)) + (1 - a) t / 1 h + b sin(4 pi t / 1 h).
class Drift : public Law {
 public:
  Drift(const Vector3d& d, const Vector3d& e, double swing_share)
      : d_(d), e_(e), swing_share_(swing_share) {}

  void bend(const Moment& now, Deflection& out) const override {
    const double t = now.visit.time_s;
    const double lag = std::expm1(-t / kLag_s) / std::expm1(-kHour_s / kLag_s);
    const double swing = swing_share_ * std::sin(4.0 * std::numbers::pi * t / kHour_s);
    const double g = kLagShare * lag + (1.0 - kLagShare) * t / kHour_s + swing;
    out.base = exp(d_ * g, e_ * g) * out.base;
  }

  nlohmann::ordered_json truth() const override {
    const Vector3d d_um = d_ * 1e6, e_urad = e_ * 1e6;
    return {{"shift_um_in_first_hour", {d_um.x(), d_um.y(), d_um.z()}},
            {"rotation_urad_in_first_hour", {e_urad.x(), e_urad.y(), e_urad.z()}},
            {"lag_s", kLag_s},
            {"lag_share", kLagShare},
            {"swing_share", swing_share_}};
  }

 private:
  Vector3d d_, e_;
  double swing_share_;
};

}  // namespace

std::unique_ptr<Law> make_drift(const HiddenEffect& effect, const World& world) {
  Random random(world.seed, "drift");
  const double size = effect.size.value_or(kUsualSize_m);
  const Vector3d d = size * random.direction();
  const Vector3d e = 0.5 * size / world.arm.reach() * random.direction();
  return std::make_unique<Drift>(d, e, kSwingShare * world.richness);
}

}  // namespace plumb::offline::sim
