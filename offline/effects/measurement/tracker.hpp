// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "effects/measured_context.hpp"
#include "plumb/runtime/detail/effect.hpp"

namespace plumb::effects {

/// Errors of the tracker: an offset and a scale error of the distance along the beam, and across it
/// second harmonics of the azimuth and elevation angles. Belongs to the measurement: fitted, never
/// compiled.
struct Tracker {
  static constexpr EffectParameter kParameters[] = {
      {"offset", "m", 30e-6, -1e-2, 1e-2},   {"scale", "1", 2e-6, -1e-2, 1e-2},
      {"az_sin2", "rad", 6e-6, -1e-3, 1e-3}, {"az_cos2", "rad", 6e-6, -1e-3, 1e-3},
      {"el_sin2", "rad", 6e-6, -1e-3, 1e-3}, {"el_cos2", "rad", 6e-6, -1e-3, 1e-3}};
  static constexpr EffectInfo kInfo{.name = "tracker",
                                    .version = 1,
                                    .title = "errors of the tracker",
                                    .domain = EffectDomain::kMeasurement,
                                    .needs = kNeedsTracker,
                                    .per_joint = false,
                                    .repeats = false,
                                    .parameters = kParameters};
  static int count(const EffectShape& shape) { return default_count<Tracker>(shape); }

  template <class S>
  static void apply(std::span<const S> a, const EffectShape&, const Situation& at,
                    const offline::MeasuredContext& measured, Motion<S>& out) {
    const Vector3 beam = at.frames.tip.p - Vector3(measured.tracker_B.data());
    const Vector3 up(measured.tracker_up_B.data());
    const double range = portable::sqrt(dot(beam, beam));
    if (!(range > 1e-3)) return;
    const Vector3 along = beam * (1.0 / range);
    const double height = dot(along, up);
    const Vector3 level = along - up * height;
    const double flat = portable::sqrt(dot(level, level));
    if (!(flat > 1e-3)) return;
    const Vector3 side = cross<double>(up, level) * (1.0 / flat);
    const Vector3 rise = cross<double>(along, side);
    // Any fixed horizontal direction will do as zero of the azimuth.
    const Vector3 other = up(0) * up(0) < 0.5 ? Vector3(1, 0, 0) : Vector3(0, 1, 0);
    Vector3 north = other - up * dot(other, up);
    north *= 1.0 / portable::sqrt(dot(north, north));
    const double cos_az = dot(level, north) / flat;
    const double sin_az = dot(level, cross<double>(up, north)) / flat;
    const S azimuth = a[2] * (2.0 * sin_az * cos_az) + a[3] * (cos_az * cos_az - sin_az * sin_az);
    const S elevation = a[4] * (2.0 * height * flat) + a[5] * (flat * flat - height * height);
    const S radial = a[0] + a[1] * range;
    for (int k = 0; k < 3; ++k)
      out.shift_B(k) +=
          radial * along(k) + azimuth * (range * flat * side(k)) + elevation * (range * rise(k));
  }
};

}  // namespace plumb::effects
