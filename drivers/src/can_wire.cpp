// SPDX-License-Identifier: Apache-2.0
#include "can_wire.hpp"

#include <linux/can/error.h>

#include <algorithm>

#include "fd_length.hpp"

namespace plumb::drivers {
namespace {

bool is_length(std::uint8_t length, CanFrame::Format format) noexcept {
  return format == CanFrame::Format::kFd ? fd_length(length) == length : length <= CAN_MAX_DLEN;
}

bool is_id(std::uint32_t id, CanFrame::Id kind) noexcept {
  return id <= (kind == CanFrame::Id::kExtended ? CAN_EFF_MASK : CAN_SFF_MASK);
}

}  // namespace

std::size_t to_wire(const CanFrame& frame, const CanLinkOptions& options,
                    canfd_frame& out) noexcept {
  const bool fd = frame.format == CanFrame::Format::kFd;
  if (fd && options.format == CanFrame::Format::kClassic) return 0;
  if (!is_length(frame.length, frame.format) || !is_id(frame.id, frame.id_kind)) return 0;
  const bool switched = fd && options.data_phase == CanLinkOptions::DataPhase::kSwitched;
  out = {};
  out.can_id = frame.id | (frame.id_kind == CanFrame::Id::kExtended ? CAN_EFF_FLAG : 0U);
  out.len = frame.length;
  out.flags = switched ? CANFD_BRS : 0;
  std::copy_n(frame.data.begin(), frame.length, out.data);
  return fd ? CANFD_MTU : CAN_MTU;
}

WireKind from_wire(const canfd_frame& in, std::size_t bytes, CanFrame::Format format,
                   CanFrame& out) noexcept {
  const bool fd = bytes == CANFD_MTU;
  if (bytes != CAN_MTU && !(fd && format == CanFrame::Format::kFd)) return WireKind::kMalformed;
  out.format = fd ? CanFrame::Format::kFd : CanFrame::Format::kClassic;
  if (!is_length(in.len, out.format)) return WireKind::kMalformed;
  if (in.can_id & CAN_ERR_FLAG)
    return fd || in.len != CAN_ERR_DLC ? WireKind::kMalformed : WireKind::kError;
  if (in.can_id & CAN_RTR_FLAG) return fd ? WireKind::kMalformed : WireKind::kRemote;
  out.id_kind = in.can_id & CAN_EFF_FLAG ? CanFrame::Id::kExtended : CanFrame::Id::kStandard;
  out.id = in.can_id & CAN_EFF_MASK;
  if (!is_id(out.id, out.id_kind)) return WireKind::kMalformed;
  out.length = in.len;
  out.data = {};
  std::copy_n(in.data, in.len, out.data.begin());
  return WireKind::kData;
}

}  // namespace plumb::drivers
