// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/loads.hpp"

namespace plumb {
namespace {

Vector3 vector(const std::array<double, 3>& v) noexcept { return {v[0], v[1], v[2]}; }

bool known(double v) noexcept { return v == v; }

struct Payload {
  double mass;
  Vector3 com_F;
};

Payload payload_of(const format::Mechanics& mechanics, const Context& context) noexcept {
  Payload out{known(context.payload_kg) ? context.payload_kg : mechanics.payload_kg,
              vector(mechanics.payload_com_m)};
  for (int k = 0; k < 3; ++k)
    if (known(context.payload_com_m[k])) out.com_F(k) = context.payload_com_m[k];
  return out;
}

double about(const Chain& chain, int j, const Transformd& X_BP, const Vector3& force,
             const Vector3& moment) noexcept {
  return dot(X_BP.R.col(2), chain.revolute(j) ? moment : force);
}

}  // namespace

void weigh(const Chain& chain, const ChainFrames<double>& frames,
           const format::Mechanics& mechanics, const std::array<double, 3>& gravity,
           const Transformd& X_TF, const Context& context, Loads& out) noexcept {
  out.gravity = vector(gravity);
  const Payload payload = payload_of(mechanics, context);
  out.payload_at = frames.tip * (X_TF * payload.com_F);
  out.payload_force = out.gravity * payload.mass;
  const Vector3 wrench = vector(context.force_N), wrench_moment = vector(context.moment_Nm);
  double mass = payload.mass;
  Vector3 first_moment = out.payload_at * payload.mass;  // [kg m]
  for (int j = chain.joints() - 1; j >= 0; --j) {
    const Transformd& X_BP = frames.joint[j];
    if (j < static_cast<int>(mechanics.links.size())) {
      const auto& link = mechanics.links[j];
      mass += link.mass_kg;
      first_moment += (X_BP * vector(link.com_m)) * link.mass_kg;
    }
    const Vector3 weight = out.gravity * mass;
    const Vector3 weight_moment = cross<double>(first_moment - X_BP.p * mass, out.gravity);
    const Vector3 tip_moment = cross<double>(frames.tip.p - X_BP.p, wrench) + wrench_moment;
    out.joint[j].force = weight + wrench;
    out.joint[j].moment = weight_moment + tip_moment;
    out.joint[j].torque = about(chain, j, X_BP, out.joint[j].force, out.joint[j].moment);
    out.payload_torque[j] = about(chain, j, X_BP, out.payload_force,
                                  cross<double>(out.payload_at - X_BP.p, out.payload_force));
    out.wrench_torque[j] = about(chain, j, X_BP, wrench, tip_moment);
  }
}

}  // namespace plumb
