// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <linux/can.h>

#include <cstddef>

#include "plumb/drivers/can_link.hpp"

namespace plumb::drivers {

/// Bytes to write for `frame`; 0: not a frame of such a link.
std::size_t to_wire(const CanFrame& frame, const CanLinkOptions& options,
                    canfd_frame& out) noexcept;

enum class WireKind : std::uint8_t { kData, kRemote, kError, kMalformed };

/// What `bytes` read into `in` are; kData: `out` is filled but for its time.
WireKind from_wire(const canfd_frame& in, std::size_t bytes, CanFrame::Format format,
                   CanFrame& out) noexcept;

}  // namespace plumb::drivers
