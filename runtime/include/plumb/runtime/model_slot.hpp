// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

#include "plumb/runtime/binding.hpp"
#include "plumb/runtime/loaded_model.hpp"

namespace plumb {

/// Hands models from one loader thread to one cycle thread while both run.
///
///     loader   publish(new) ........... settled() false ... settled() true: free the old one
///     cycle    ... old ... old ... take() = new: acknowledged ... new ... new ...
///
/// Only one model is handed over at a time, so at most two exist. By taking the new model the cycle
/// acknowledges that it no longer uses the old one, so a model in use is never freed.
/// The slot owns nothing: the loader must keep both models until settled(), and the last one until
/// the cycle's thread has ended.
///
/// Heap: none. Cost: at most two loads and a store; wait-free on both sides. Only plain atomic
/// loads and stores are used, which no machine implements by a call into the compiler's library.
class ModelSlot {
 public:
  /// Binds the slot to the robot of the first model.
  explicit ModelSlot(const LoadedModel& first) noexcept : offered_(&first), taken_(&first) {}

  ModelSlot(const ModelSlot&) = delete;
  ModelSlot& operator=(const ModelSlot&) = delete;

  enum class [[nodiscard]] Published : std::uint8_t{
      kDone,
      kBusy,       // the cycle has not yet taken the previous model: try again later
      kOtherRobot  // refused; find_binding_fault tells why
  };

  /// Loader thread: offers `next` to the cycle. Belongs to the load phase.
  Published publish(const LoadedModel& next) noexcept {
    if (!settled()) return Published::kBusy;
    const LoadedModel& running = *offered_.load(std::memory_order_relaxed);
    if (find_binding_fault(running.model(), next.model()) != BindingFault::kNone)
      return Published::kOtherRobot;
    offered_.store(&next, std::memory_order_release);
    return Published::kDone;
  }

  /// Loader thread: true if the cycle uses the model published last, and no other any more.
  bool settled() const noexcept {
    return taken_.load(std::memory_order_acquire) == offered_.load(std::memory_order_relaxed);
  }

  /// Cycle thread, between two cycles: the model to use until the next call.
  const LoadedModel& take() noexcept {
    const LoadedModel* now = offered_.load(std::memory_order_acquire);
    taken_.store(now, std::memory_order_release);
    return *now;
  }

 private:
  using Pointer = std::atomic<const LoadedModel*>;
  static_assert(Pointer::is_always_lock_free);

  Pointer offered_;
  Pointer taken_;
};

}  // namespace plumb
