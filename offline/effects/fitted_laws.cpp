// SPDX-License-Identifier: Apache-2.0
#include "effects/fitted_laws.hpp"

namespace plumb::offline {

const EffectInfo& fitted_law_info(int law) {
  const EffectInfo* out = &std::tuple_element_t<0, FittedLaws>::kInfo;
  with_law<FittedLaws>(law, [&](auto found) { out = &decltype(found)::kInfo; });
  return *out;
}

int find_fitted_law(std::string_view name) {
  for (int law = 0; law < kFittedLaws; ++law)
    if (fitted_law_info(law).name == name) return law;
  return -1;
}

int fitted_parameter_count(int law, const EffectShape& shape) {
  int out = 0;
  with_law<FittedLaws>(law, [&](auto found) { out = decltype(found)::count(shape); });
  return out;
}

}  // namespace plumb::offline
