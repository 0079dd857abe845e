// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/binding.hpp"

#include "plumb/runtime/detail/effect_set.hpp"

namespace plumb {
namespace {

bool same_joint(const format::JointRow& a, const format::JointRow& b) noexcept {
  return a.type == b.type && a.alpha == b.alpha && a.a == b.a && a.d == b.d && a.theta == b.theta &&
         a.beta == b.beta && a.scale == b.scale && a.offset == b.offset && a.pre == b.pre &&
         a.post == b.post;
}

bool same_chain(const format::Chain& a, const format::Chain& b) noexcept {
  bool same = a.convention == b.convention && a.base == b.base && a.base_twist == b.base_twist &&
              a.tool == b.tool && a.tool_twist == b.tool_twist && a.coupling == b.coupling &&
              a.joints.size() == b.joints.size();
  for (std::size_t i = 0; same && i < a.joints.size(); ++i)
    same = same_joint(a.joints[i], b.joints[i]);
  return same;
}

bool same_sensors(const format::Model& a, const format::Model& b) noexcept {
  bool same = true;
  for (int k = 0; k < format::kMaxTemperatures; ++k) {
    const std::string* in_a = temperature_name(a, k);
    const std::string* in_b = temperature_name(b, k);
    same = same && (in_a == nullptr || in_b == nullptr || *in_a == *in_b);
  }
  return same;
}

}  // namespace

BindingFault find_binding_fault(const format::Model& running, const format::Model& next) noexcept {
  if (running.serial != next.serial) return BindingFault::kSerial;
  if (!same_chain(running.nominal, next.nominal)) return BindingFault::kNominal;
  if (!same_sensors(running, next)) return BindingFault::kSensors;
  return BindingFault::kNone;
}

const char* to_string(BindingFault fault) noexcept {
  switch (fault) {
    case BindingFault::kNone:
      return "the same robot";
    case BindingFault::kSerial:
      return "made for another robot: the serial differs";
    case BindingFault::kNominal:
      return "made for another controller set-up: the nominal chain, base or tool differs";
    case BindingFault::kSensors:
      return "its temperature sensors are counted in another order";
  }
  return "unknown";
}

}  // namespace plumb
