// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include "plumb/format/model.hpp"
#include "plumb/runtime/corrector.hpp"
#include "plumb/runtime/coupling.hpp"
#include "plumb/runtime/detail/effect_set.hpp"

namespace plumb {

/// A model that is ready to run: the result of read_model, whose effects this library knows, and
/// the corrector that refers to it. It never changes and is never moved.
///
/// `make` and the destructor belong to the load phase: they use the heap, on any thread. All else
/// may be called in the cycle.
class LoadedModel {
 public:
  /// Null if find_effect_fault(model) finds a fault. The model must come from read_model. `number`:
  /// an identification of the caller's choice, which number() returns.
  static std::unique_ptr<const LoadedModel> make(format::Model model, std::uint32_t number = 0) {
    if (find_effect_fault(model).kind != EffectFault::Kind::kNone) return nullptr;
    return std::unique_ptr<const LoadedModel>(new LoadedModel(std::move(model), number));
  }

  LoadedModel(const LoadedModel&) = delete;
  LoadedModel& operator=(const LoadedModel&) = delete;

  const format::Model& model() const noexcept { return model_; }
  const Corrector& corrector() const noexcept { return corrector_; }
  /// From the controller's joint values to the joint angles that the corrector knows.
  const Coupling& coupling() const noexcept { return coupling_; }
  const format::GuardLimits& limits() const noexcept { return corrector_.limits(); }
  std::uint32_t number() const noexcept { return number_; }

 private:
  LoadedModel(format::Model model, std::uint32_t number)
      : coupling_(model.nominal.coupling),
        number_(number),
        model_(std::move(model)),
        corrector_(model_) {}

  Coupling coupling_;
  std::uint32_t number_;
  format::Model model_;
  Corrector corrector_;
};

}  // namespace plumb
