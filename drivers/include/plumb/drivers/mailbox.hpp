// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>

namespace plumb::drivers {

/// Passes the newest value of one thread to another. A value not taken in time is overwritten.
///
///     writer's slot --put()--> middle slot --take()--> reader's slot      three slots change
///     places
///
/// put() is for one thread, take() for one thread, the same or another. Both are wait-free (a copy
/// and one atomic exchange), without allocation or system call. A value is never read in part or
/// twice.
template <class T>
class Mailbox {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  void put(const T& value) noexcept {
    slots_[writer_].value = value;
    writer_ = middle_.exchange(writer_ | kFresh, std::memory_order_acq_rel) & kIndex;
  }

  /// Takes the newest value. False: there is none since the last take.
  bool take(T& out) noexcept {
    if ((middle_.load(std::memory_order_relaxed) & kFresh) == 0) return false;
    reader_ = middle_.exchange(reader_, std::memory_order_acq_rel) & kIndex;
    out = slots_[reader_].value;
    return true;
  }

 private:
  static constexpr std::uint32_t kIndex = 3;
  static constexpr std::uint32_t kFresh = 4;

  struct alignas(64) Slot {
    T value{};
  };
  std::array<Slot, 3> slots_;
  alignas(64) std::uint32_t writer_ = 0;
  alignas(64) std::atomic<std::uint32_t> middle_{1};
  alignas(64) std::uint32_t reader_ = 2;
};

}  // namespace plumb::drivers
