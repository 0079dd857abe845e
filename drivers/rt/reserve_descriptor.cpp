// SPDX-License-Identifier: Apache-2.0
#include "rt/reserve_descriptor.hpp"

#include <fcntl.h>

namespace plumb::drivers::rt {

void ReserveDescriptor::take() noexcept {
  if (!held()) held_ = Descriptor(::open("/dev/null", O_RDONLY | O_CLOEXEC));
}

}  // namespace plumb::drivers::rt
