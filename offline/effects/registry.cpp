// SPDX-License-Identifier: Apache-2.0
#include "effects/registry.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <tuple>

#include "effects/descriptors.hpp"
#include "effects/fitted_laws.hpp"

namespace plumb::offline {
namespace {

using AllDescriptors = std::array<const EffectDescriptor*, 2 + kFittedLaws>;

/// A law of the library without a line in descriptors.hpp does not compile here.
const AllDescriptors& all_descriptors() {
  static const AllDescriptors all = std::apply(
      [](auto... law) {
        return AllDescriptors{&geometry_descriptor(), &local_tree_descriptor(),
                              &law_descriptor(law)...};
      },
      FittedLaws{});
  return all;
}

bool is_searched_as(std::string_view name, Search search) {
  const EffectDescriptor* found = find_descriptor(name);
  return found != nullptr && found->search == search;
}

std::string effect_searched_as(Search search) {
  const auto all = effect_descriptors();
  const auto found = std::find_if(
      all.begin(), all.end(), [&](const EffectDescriptor* one) { return one->search == search; });
  return std::string((*found)->name);
}

}  // namespace

std::span<const EffectDescriptor* const> effect_descriptors() { return all_descriptors(); }

const EffectDescriptor* find_descriptor(std::string_view name) {
  for (const EffectDescriptor* one : all_descriptors())
    if (one->name == name) return one;
  return nullptr;
}

const EffectDescriptor& descriptor_of(std::string_view name) {
  const EffectDescriptor* found = find_descriptor(name);
  if (found == nullptr) throw std::out_of_range("no effect named '" + std::string(name) + "'");
  return *found;
}

bool is_geometry(std::string_view name) { return name == geometry_descriptor().name; }
bool is_local_tree(std::string_view name) { return name == local_tree_descriptor().name; }
bool is_wave(std::string_view name) { return is_searched_as(name, Search::kWaves); }
bool is_series(std::string_view name) { return is_searched_as(name, Search::kSeries); }
bool is_change_point(std::string_view name) { return is_searched_as(name, Search::kChangePoint); }
bool is_formula(std::string_view name) { return name == effects::Formula::kInfo.name; }

bool is_of_measurement(std::string_view name) {
  const EffectDescriptor* effect = find_descriptor(name);
  return effect != nullptr && effect->law != nullptr &&
         effect->law->domain == EffectDomain::kMeasurement;
}

bool grows_with_load(const EffectDescriptor& effect) {
  const unsigned needs = effect.law != nullptr ? effect.law->needs : 0U;
  return (needs & (kNeedsMasses | kNeedsPayload)) != 0 || effect.cause == Cause::kYieldingJoint;
}

std::string geometry_effect() { return std::string(geometry_descriptor().name); }
std::string wave_effect() { return effect_searched_as(Search::kWaves); }
std::string series_effect() { return effect_searched_as(Search::kSeries); }
std::string change_point_effect() { return effect_searched_as(Search::kChangePoint); }
std::string formula_effect() { return std::string(effects::Formula::kInfo.name); }

}  // namespace plumb::offline
