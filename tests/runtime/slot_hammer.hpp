// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <memory>
#include <thread>

#include "plumb/runtime/loaded_model.hpp"
#include "tests/rt/one_arm.hpp"

/// A loader at full speed against a cycle at full speed.
namespace plumb::test {

/// Model number k, which says its number in five places, three of them on the heap.
inline std::unique_ptr<const LoadedModel> numbered(int k) {
  static const format::Model kArm = tests::one_arm();
  format::Model model = kArm;
  const double number = k;
  model.gravity[0] = number;
  model.guard.ramp_s = number;
  model.calibrated.joints.back().d = number;
  model.domain.q_max.back() = number;
  model.trees[2].coefficients.back() = number;
  return LoadedModel::make(std::move(model));
}

/// Its number, or -1 if the places disagree: torn, or freed and used again.
inline double number_of(const LoadedModel& loaded) {
  const format::Model& model = loaded.model();
  const double number = model.gravity[0];
  const bool whole =
      loaded.limits().ramp_s == number && model.calibrated.joints.back().d == number &&
      model.domain.q_max.back() == number && model.trees[2].coefficients.back() == number;
  return whole ? number : -1.0;
}

struct Hammered {
  long cycles = 0;
  long seen = 0;  // different models
  long wrong = 0;
  double last = 0.0;
};

/// The cycle: takes the model, looks at it twice, and never goes back to an older one.
template <class Slot>
Hammered cycle(Slot& slot, const std::atomic<bool>& stop) {
  Hammered out;
  while (!stop.load(std::memory_order_relaxed)) {
    const LoadedModel& model = slot.take();
    const double first = number_of(model), second = number_of(model);
    out.wrong += first != second || first < out.last ? 1 : 0;
    out.seen += first != out.last ? 1 : 0;
    out.last = first;
    ++out.cycles;
  }
  return out;
}

/// The loader: frees the old model as soon as the slot says that it may.
template <class Slot>
void load(Slot& slot, std::unique_ptr<const LoadedModel> running, int swaps,
          std::atomic<bool>& stop) {
  for (int k = 2; k <= swaps + 1; ++k) {
    auto next = numbered(k);
    while (slot.publish(*next) != Slot::Published::kDone) std::this_thread::yield();
    while (!slot.settled()) std::this_thread::yield();
    running = std::move(next);
  }
  stop.store(true);
  // The cycle may still be looking at the last model.
  static std::unique_ptr<const LoadedModel> kept;
  kept = std::move(running);
}

template <class Slot>
Hammered hammer(int swaps) {
  auto first = numbered(1);
  Slot slot(*first);
  std::atomic<bool> stop{false};
  Hammered out;
  std::thread cycling([&] { out = cycle(slot, stop); });
  load(slot, std::move(first), swaps, stop);
  cycling.join();
  return out;
}

}  // namespace plumb::test
