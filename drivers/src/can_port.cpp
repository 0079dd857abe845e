// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/can_port.hpp"

#include <algorithm>
#include <utility>

namespace plumb::drivers {

CanPortOpening CanPort::open(std::string_view interface, const BusLayout& layout, Sender self) {
  CanOpening opening = CanLink::open(interface, can_filters(layout), can_link_options(layout));
  CanPortOpening out{.step = opening.step, .port = {}};
  if (opening.link) out.port.emplace(std::move(*opening.link), layout, self);
  return out;
}

CanPort::CanPort(CanLink link, const BusLayout& layout, Sender self)
    : link_(std::move(link)), codec_(layout), self_(self), id_kind_(layout.id_kind) {
  for (const auto& message : layout.messages)
    ids_.push_back({.first = message.can_id,
                    .count = static_cast<std::uint32_t>(can_frames(layout, message)),
                    .kind = message.kind,
                    .sender = message.sender});
}

const CanPort::Ids* CanPort::find(const CanFrame& frame) const noexcept {
  if (frame.id_kind != id_kind_) return nullptr;
  const auto it = std::find_if(ids_.begin(), ids_.end(), [&](const Ids& ids) {
    return frame.id >= ids.first && frame.id - ids.first < ids.count;
  });
  return it == ids_.end() ? nullptr : &*it;
}

bool CanPort::receive(BusMessage& message) noexcept {
  CanFrame frame;
  for (int i = 0; i < kMostFramesACall; ++i) {
    if (!link_.receive(frame)) return false;
    if (takes(frame, message)) return true;
  }
  return false;
}

bool CanPort::takes(const CanFrame& frame, BusMessage& message) noexcept {
  const Ids* const ids = find(frame);
  if (ids == nullptr) return false;
  if (ids->sender == self_) {
    ++counters_.foreign_senders;
    return false;
  }
  switch (codec_.hear(frame, message)) {
    case Heard::kComplete:
      ++counters_.received;
      return true;
    case Heard::kRepeated:
      ++counters_.repeated;
      return false;
    case Heard::kCorrupt:
      ++counters_.corrupt;
      return false;
    case Heard::kPart:
    case Heard::kNotOurs:
    case Heard::kNothing:
      return false;
  }
  return false;
}

bool CanPort::sends(MessageKind kind) const noexcept {
  return std::any_of(ids_.begin(), ids_.end(),
                     [&](const Ids& ids) { return ids.kind == kind && ids.sender == self_; });
}

bool CanPort::send(const BusMessage& message) noexcept {
  const auto frames = sends(message.kind) ? codec_.encode(message) : std::span<const CanFrame>();
  const bool sent =
      !frames.empty() &&
      std::all_of(frames.begin(), frames.end(), [&](const CanFrame& f) { return link_.send(f); });
  ++(sent ? counters_.sent : counters_.not_sent);
  return sent;
}

PortCounters CanPort::counters() const noexcept {
  const CanLinkCounters link = link_.counters();
  PortCounters out = counters_;
  out.corrupt += link.malformed;
  out.skipped = codec_.skipped();
  out.overflowed = link.overflowed;
  out.reconnects = link_.reconnects();
  return out;
}

std::vector<CanFilter> can_filters(const BusLayout& layout) {
  std::vector<CanFilter> out;
  for (const auto& message : layout.messages)
    for (std::size_t i = 0; i < can_frames(layout, message); ++i)
      out.push_back(
          {.id = message.can_id + static_cast<std::uint32_t>(i), .id_kind = layout.id_kind});
  return out;
}

CanLinkOptions can_link_options(const BusLayout& layout) {
  using DataPhase = CanLinkOptions::DataPhase;
  return {.format = layout.can_format,
          .data_phase =
              layout.data_bit_rate > layout.bit_rate ? DataPhase::kSwitched : DataPhase::kOneRate};
}

}  // namespace plumb::drivers
