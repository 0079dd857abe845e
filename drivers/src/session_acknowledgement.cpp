// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/session_acknowledgement.hpp"

namespace plumb::drivers {

bool AcknowledgeButton::hear(const BusMessage& message, bool asked) noexcept {
  const auto said = possible_controller(message);
  const bool gap = message.time_ns - heard_ns_ >= kGap_ns || message.time_ns < heard_ns_;
  heard_ns_ = message.time_ns;
  if (!said || gap || !asked) forget();
  if (!said) return false;
  if (said->acknowledge) {
    if (press_ == Press::kOff) begun_ns_ = message.time_ns;
    if (press_ == Press::kOff) press_ = Press::kOn;
    return false;
  }
  const bool held = press_ == Press::kOn && message.time_ns - begun_ns_ >= kHeld_ns;
  press_ = Press::kOff;
  return held;
}

}  // namespace plumb::drivers
