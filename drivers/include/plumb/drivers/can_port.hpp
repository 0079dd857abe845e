// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "plumb/drivers/bus_layout.hpp"
#include "plumb/drivers/bus_port.hpp"
#include "plumb/drivers/can_codec.hpp"
#include "plumb/drivers/can_link.hpp"

namespace plumb::drivers {

struct CanPortOpening;

/// Exchanges the messages of a layout over one CAN interface, either as plumb-rt, which receives
/// what the controller sends, or as the controller.
///
/// A received frame with one of our own identifiers was sent by someone else and counts in
/// foreign_senders. Frames with a wrong length, checksum or value, and malformed frames, count as
/// corrupt.
///
/// receive() examines at most kMostFramesACall frames and then returns false, so that a flood of
/// frames that complete no message cannot delay the cycle. A flood of complete messages is limited
/// by the caller (RunLoop::kMostMessages). Heap: only in the constructor. Thread: one; recover()
/// may run in another.
class CanPort final : public BusPort {
 public:
  /// Chosen: the frames of several cycles of any layout; more can only be a flood.
  static constexpr int kMostFramesACall = 64;

  /// Opens a port. Slow. Precondition: find_faults finds none in the layout.
  static CanPortOpening open(std::string_view interface, const BusLayout& layout, Sender self);

  CanPort(CanLink link, const BusLayout& layout, Sender self);

  bool receive(BusMessage& message) noexcept override;

  /// Sends all frames of the message. False: not all were sent; the receiver then discards the
  /// incomplete message.
  bool send(const BusMessage& message) noexcept override;

  LinkState state() const noexcept override { return link_.state(); }
  PortCounters counters() const noexcept override;

  const CanLink& link() const noexcept { return link_; }

  /// Binds again after an interface came back; to be called in state() kDown, see CanLink.
  bool recover() const { return link_.recover(); }

 private:
  struct Ids {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    MessageKind kind = MessageKind::kJoints;
    Sender sender = Sender::kController;
  };

  const Ids* find(const CanFrame& frame) const noexcept;
  bool takes(const CanFrame& frame, BusMessage& message) noexcept;
  bool sends(MessageKind kind) const noexcept;

  CanLink link_;
  CanCodec codec_;
  Sender self_;
  CanFrame::Id id_kind_;
  std::vector<Ids> ids_;
  PortCounters counters_;
};

/// A port, or the step that was denied.
struct CanPortOpening {
  CanStep step;
  std::optional<CanPort> port;
};

/// The identifiers that a link must receive for this layout: those of the other end, and our own,
/// so that another sender of them is noticed.
std::vector<CanFilter> can_filters(const BusLayout& layout);

/// The options of a link for this layout. The data phase is switched to a bit rate of its own only
/// if the layout has a different one for it.
CanLinkOptions can_link_options(const BusLayout& layout);

}  // namespace plumb::drivers
