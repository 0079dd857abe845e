// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <linux/can.h>

#include <cstddef>

#include "plumb/drivers/can_link_options.hpp"

namespace plumb::drivers {

/// The number of bytes to write for `frame`, or 0 if a link with these options cannot send it.
std::size_t to_wire(const CanFrame& frame, const CanLinkOptions& options,
                    canfd_frame& out) noexcept;

enum class WireKind : std::uint8_t { kData, kRemote, kError, kMalformed };

/// The kind of a frame of which `bytes` bytes were read into `in`. For kData, `out` is filled
/// except for its time.
WireKind from_wire(const canfd_frame& in, std::size_t bytes, CanFrame::Format format,
                   CanFrame& out) noexcept;

}  // namespace plumb::drivers
