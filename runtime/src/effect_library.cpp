// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/effect_library.hpp"

namespace plumb {

const EffectInfo& effect_info(int law) noexcept {
  const EffectInfo* out = &effects::JointCompliance::kInfo;
  with_law(law, [&](auto found) { out = &decltype(found)::kInfo; });
  return *out;
}

int find_effect_law(std::string_view name) noexcept {
  for (int law = 0; law < kEffectLaws; ++law)
    if (effect_info(law).name == name) return law;
  return -1;
}

int effect_parameter_count(int law, const EffectShape& shape) noexcept {
  int out = 0;
  with_law(law, [&](auto found) { out = decltype(found)::count(shape); });
  return out;
}

}  // namespace plumb
