// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plumb/drivers/descriptor.hpp"

namespace plumb::drivers::rt {

/// A file descriptor that is kept for the moment when the process or the system has no other left:
/// it is given up for a connection that waits, and taken again once that was answered.
///
/// Thread: one.
class ReserveDescriptor {
 public:
  ReserveDescriptor() { take(); }

  /// Takes it, if it is not held. Slow.
  void take() noexcept;
  void give_up() noexcept { held_ = Descriptor(); }
  bool held() const noexcept { return held_.open(); }

 private:
  Descriptor held_;
};

}  // namespace plumb::drivers::rt
