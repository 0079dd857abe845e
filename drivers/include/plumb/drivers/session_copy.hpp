// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstring>
#include <span>

#include "plumb/drivers/session.hpp"

namespace plumb::drivers {

/// Hands the memory of the session to the thread that records, so that a replay can begin there.
///
///     recorder  ask() ........................ takes the entry kState ... reads bytes() ... ask()
///     cycle     ....... asked(): put(), entry kState in the record's ring, given() .............
///
/// The recorder asks again only when it has taken that entry and read the bytes, so nobody writes
/// what it reads.
///
/// Cost: one load a cycle, and a copy of some ten kB in the few cycles that are asked. Wait-free;
/// no allocation, no system call.
class SessionCopy {
 public:
  void ask() noexcept { asked_.store(true, std::memory_order_release); }          // recorder
  bool asked() const noexcept { return asked_.load(std::memory_order_acquire); }  // cycle
  void put(const Session& session) noexcept {
    std::memcpy(bytes_.data(), &session, sizeof session);
  }
  void given() noexcept { asked_.store(false, std::memory_order_relaxed); }  // cycle
  std::span<const std::byte> bytes() const noexcept { return bytes_; }       // recorder

 private:
  std::array<std::byte, sizeof(Session)> bytes_{};
  std::atomic<bool> asked_{false};
};

}  // namespace plumb::drivers
