// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

#include "plumb/runtime/binding.hpp"
#include "plumb/runtime/loaded_model.hpp"

namespace plumb {

/// Where one loader thread hands models to one cycle thread, while both run.
///
///     loader   publish(new) ........... settled() false ... settled() true: free the old one
///     cycle    ... old ... old ... take() = new: acknowledged ... new ... new ...
///
/// One model is under way at a time, so at most two exist, and a model is never freed under the
/// cycle: taking the new one is the acknowledgement that the old one is done with.
/// The slot owns nothing: the loader keeps both models until settled(), and everything until the
/// cycle's thread has ended.
///
/// Heap: none. Cost: two loads and a store at most; wait-free on both sides; plain loads and
/// stores, so no helper of a compiler's library is called on any machine.
class ModelSlot {
 public:
  /// Binds the slot to the robot of the first model.
  explicit ModelSlot(const LoadedModel& first) noexcept : offered_(&first), taken_(&first) {}

  ModelSlot(const ModelSlot&) = delete;
  ModelSlot& operator=(const ModelSlot&) = delete;

  enum class [[nodiscard]] Published : std::uint8_t{
      kDone,
      kBusy,       // the cycle has not yet taken the one before: try again later
      kOtherRobot  // find_binding_fault says why; it never reaches the cycle
  };

  /// Loader thread, load phase.
  Published publish(const LoadedModel& next) noexcept {
    if (!settled()) return Published::kBusy;
    const LoadedModel& running = *offered_.load(std::memory_order_relaxed);
    if (find_binding_fault(running.model(), next.model()) != BindingFault::kNone)
      return Published::kOtherRobot;
    offered_.store(&next, std::memory_order_release);
    return Published::kDone;
  }

  /// Loader thread: the cycle runs on the model published last, and on no other any more.
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
