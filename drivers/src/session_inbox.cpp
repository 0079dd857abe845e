// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/session_inbox.hpp"

#include <algorithm>

namespace plumb::drivers {

void SessionInbox::hear(const BusMessage& message) noexcept {
  last_[at(message.kind)] = message;
  came_[at(message.kind)] = true;
}

void SessionInbox::step(std::int64_t now_ns, double ageing_s) noexcept {
  for (std::size_t i = 0; i < kMessageKinds; ++i) {
    age_[i].advance(ageing_s);
    const double waited_s = 1e-9 * static_cast<double>(now_ns - last_[i].time_ns);
    if (came_[i]) age_[i].renew(std::max(0.0, waited_s));
  }
}

}  // namespace plumb::drivers
