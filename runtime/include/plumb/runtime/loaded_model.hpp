// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include "plumb/format/model.hpp"
#include "plumb/runtime/corrector.hpp"
#include "plumb/runtime/effect_set.hpp"

namespace plumb {

/// A model that may run: what a reader returned, its effects known to this library, with the
/// corrector that refers to it. Never changes; stays where it is until nobody uses it.
///
/// Load phase: `make` and the destructor use the heap, on any thread that may. Cycle: the rest.
class LoadedModel {
 public:
  /// Null if find_effect_fault(model) finds something. The model comes from read_model. `number`:
  /// what the caller knows it by.
  static std::unique_ptr<const LoadedModel> make(format::Model model, std::uint32_t number = 0) {
    if (find_effect_fault(model).kind != EffectFault::Kind::kNone) return nullptr;
    return std::unique_ptr<const LoadedModel>(new LoadedModel(std::move(model), number));
  }

  LoadedModel(const LoadedModel&) = delete;
  LoadedModel& operator=(const LoadedModel&) = delete;

  const format::Model& model() const noexcept { return model_; }
  const Corrector& corrector() const noexcept { return corrector_; }
  const format::GuardLimits& limits() const noexcept { return corrector_.limits(); }
  std::uint32_t number() const noexcept { return number_; }

 private:
  LoadedModel(format::Model model, std::uint32_t number)
      : number_(number), model_(std::move(model)), corrector_(model_) {}

  std::uint32_t number_;
  format::Model model_;
  Corrector corrector_;
};

}  // namespace plumb
