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

}  // namespace

void weigh(const Chain& chain, const ChainFrames<double>& frames,
           const format::Mechanics& mechanics, const std::array<double, 3>& gravity,
           const Transformd& X_TF, const Context& context, Loads& out) noexcept {
  out.gravity = vector(gravity);
  const Payload payload = payload_of(mechanics, context);
  out.payload_at = frames.tip * (X_TF * payload.com_F);
  out.payload_force = out.gravity * payload.mass;
  out.wrench = vector(context.force_N);
  out.tip_moment = vector(context.moment_Nm);
  Loads::Behind behind{payload.mass, out.payload_at * payload.mass};
  const int links = static_cast<int>(mechanics.links.size());
  for (int j = chain.joints() - 1; j >= 0; --j) {
    if (j < links) {
      const auto& link = mechanics.links[j];
      behind.mass += link.mass_kg;
      behind.first_moment += (frames.joint[j] * vector(link.com_m)) * link.mass_kg;
    }
    out.joint[j] = behind;
  }
}

}  // namespace plumb
