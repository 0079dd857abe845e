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

/// The messages of a layout over one CAN interface, from one end: as plumb-rt (hears what the
/// controller sends), or as the controller.
///
/// A frame with an identifier that only we send, received, is someone else's: foreign_senders. A
/// frame whose length, check sum or values are wrong, and what is no frame at all, is corrupt.
///
/// receive() takes no more than kMostFramesACall frames and then says that there is none, so a
/// flood of frames without a message does not hold up the cycle; of a flood of messages the caller
/// takes as many as it likes. Heap: only when made. Thread: one; recover() may run in another.
class CanPort final : public BusPort {
 public:
  static constexpr int kMostFramesACall = 64;

  /// Slow. The layout has no faults (find_faults).
  static CanPortOpening open(std::string_view interface, const BusLayout& layout, Sender self);

  CanPort(CanLink link, const BusLayout& layout, Sender self);

  bool receive(BusMessage& message) noexcept override;

  /// All frames of the message, or false. What was begun and not completed the other end drops.
  bool send(const BusMessage& message) noexcept override;

  LinkState state() const noexcept override { return link_.state(); }
  PortCounters counters() const noexcept override;

  const CanLink& link() const noexcept { return link_; }

  /// For state() kDown; see CanLink.
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

/// What a link has to listen to for this layout: what the other end sends, and our own identifiers,
/// which no one else may use.
std::vector<CanFilter> can_filters(const BusLayout& layout);

/// A data phase of its own only if the layout has another bit rate for it.
CanLinkOptions can_link_options(const BusLayout& layout);

}  // namespace plumb::drivers
