// SPDX-License-Identifier: Apache-2.0
#include "rt/record_line.hpp"

#include <fmt/format.h>

#include <charconv>

namespace plumb::drivers::rt {
namespace {

constexpr std::int64_t kSecond_us = 1'000'000, kMicro_ns = 1'000;
constexpr std::uint8_t kStopFlag = 1, kSleptFlag = 2, kRestartedFlag = 4, kRefusedFlag = 8;
constexpr std::uint8_t kAcknowledgeFlag = 1;

template <class T>
bool read(std::string_view text, T& out, int base = 10) {
  const auto end = std::from_chars(text.data(), text.data() + text.size(), out, base);
  return !text.empty() && end.ec == std::errc() && end.ptr == text.data() + text.size();
}

/// The text up to `mark`, taken off with it.
std::optional<std::string_view> taken(std::string_view& text, std::string_view mark) {
  const std::size_t at = text.find(mark);
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view out = text.substr(0, at);
  text.remove_prefix(at + mark.size());
  return out;
}

bool read_time(std::string_view text, std::int64_t& out_ns) {
  const auto whole = taken(text, ".");
  std::int64_t seconds = 0, micros = 0;
  constexpr std::int64_t kMost_s = 9'000'000'000;
  if (!whole || !read(*whole, seconds) || text.size() != 6 || !read(text, micros)) return false;
  if (seconds < 0 || seconds > kMost_s || micros < 0) return false;
  out_ns = (seconds * kSecond_us + micros) * kMicro_ns;
  return true;
}

bool read_data(std::string_view text, CanFrame& out) {
  const std::size_t most = out.format == CanFrame::Format::kFd ? CanFrame::kMostBytes : 8;
  if (text.size() % 2 != 0 || text.size() / 2 > most) return false;
  out.length = static_cast<std::uint8_t>(text.size() / 2);
  for (std::size_t i = 0; i < out.length; ++i)
    if (!read(text.substr(2 * i, 2), out.data[i], 16)) return false;
  return true;
}

bool read_frame(std::string_view text, CanFrame& out) {
  const auto id = taken(text, "#");
  if (!id || !read(*id, out.id, 16)) return false;
  out.id_kind = id->size() > 3 ? CanFrame::Id::kExtended : CanFrame::Id::kStandard;
  if (text.starts_with("#")) {
    if (text.size() < 2) return false;
    out.format = CanFrame::Format::kFd;
    text.remove_prefix(2);  // the second # and the flags
  }
  return read_data(text, out);
}

}  // namespace

std::string to_line(const RecordLine& line) {
  const CanFrame& frame = line.frame;
  const std::int64_t us = frame.time_ns / kMicro_ns;
  std::string out =
      fmt::format("({:010}.{:06}) {} ", us / kSecond_us, us % kSecond_us, line.interface);
  const bool extended = frame.id_kind == CanFrame::Id::kExtended;
  out += extended ? fmt::format("{:08X}#", frame.id) : fmt::format("{:03X}#", frame.id);
  if (frame.format == CanFrame::Format::kFd) out += "#1";
  for (std::size_t i = 0; i < frame.length; ++i) out += fmt::format("{:02X}", frame.data[i]);
  return out;
}

std::optional<RecordLine> parse_line(std::string_view text) {
  RecordLine out;
  if (!text.starts_with("(")) return std::nullopt;
  text.remove_prefix(1);
  const auto time = taken(text, ") ");
  const auto interface = taken(text, " ");
  if (!time || !interface || !read_time(*time, out.frame.time_ns)) return std::nullopt;
  out.interface = *interface;
  while (text.ends_with("\r") || text.ends_with(" ")) text.remove_suffix(1);
  return read_frame(text, out.frame) ? std::optional(out) : std::nullopt;
}

CanFrame tick_frame(const RecordedTick& tick) {
  CanFrame out{.length = 8, .time_ns = tick.told.now_ns};
  if (tick.told.run == SessionTick::Run::kStop) out.data[0] |= kStopFlag;
  if (tick.told.host == SessionTick::Host::kSlept) out.data[0] |= kSleptFlag;
  if (tick.told.peer == SessionTick::Peer::kRestarted) out.data[0] |= kRestartedFlag;
  if (tick.told.answers == SessionTick::Answers::kRefused) out.data[0] |= kRefusedFlag;
  for (unsigned i = 0; i < 3; ++i)
    out.data[1 + i] = static_cast<std::uint8_t>(tick.model >> (8 * i));
  for (unsigned i = 0; i < 4; ++i)
    out.data[4 + i] = static_cast<std::uint8_t>(tick.told.foreign_senders >> (8 * i));
  return out;
}

RecordedTick tick_in(const CanFrame& frame) {
  RecordedTick out{.told = {.now_ns = frame.time_ns}};
  for (unsigned i = 0; i < 3; ++i)
    out.model |= static_cast<std::uint32_t>(frame.data[1 + i]) << (8 * i);
  for (unsigned i = 0; i < 4; ++i)
    out.told.foreign_senders |= static_cast<std::uint64_t>(frame.data[4 + i]) << (8 * i);
  if ((frame.data[0] & kStopFlag) != 0) out.told.run = SessionTick::Run::kStop;
  if ((frame.data[0] & kSleptFlag) != 0) out.told.host = SessionTick::Host::kSlept;
  if ((frame.data[0] & kRestartedFlag) != 0) out.told.peer = SessionTick::Peer::kRestarted;
  if ((frame.data[0] & kRefusedFlag) != 0) out.told.answers = SessionTick::Answers::kRefused;
  return out;
}

CanFrame start_frame(const SessionStart& start, std::int64_t now_ns) {
  CanFrame out{.length = 8, .time_ns = now_ns};
  if (start.acknowledgement == SessionStart::Acknowledgement::kNeeded)
    out.data[0] = kAcknowledgeFlag;
  out.data[1] = static_cast<std::uint8_t>(start.fault);
  return out;
}

SessionStart start_in(const CanFrame& frame) {
  SessionStart out;
  if ((frame.data[0] & kAcknowledgeFlag) != 0)
    out.acknowledgement = SessionStart::Acknowledgement::kNeeded;
  if (frame.data[1] < kFaultCauses) out.fault = static_cast<FaultCause>(frame.data[1]);
  return out;
}

}  // namespace plumb::drivers::rt
