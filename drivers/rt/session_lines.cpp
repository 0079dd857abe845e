// SPDX-License-Identifier: Apache-2.0
#include "rt/session_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <string_view>

#include "plumb/drivers/session.hpp"
#include "program/file.hpp"
#include "rt/record_line.hpp"

namespace plumb::drivers::rt {
namespace {

constexpr std::size_t kPart = CanFrame::kMostBytes;
static_assert(sizeof(Session) / kPart < 0x7FF,
              "frames of a copy are numbered as 11-bit frames are");

/// To be raised whenever members of Session or of its parts change, so that a copy is never read
/// by a program that would take its bytes for something else.
constexpr int kLayoutVersion = 2;

std::uint64_t first_of(std::string_view bytes) {
  const std::string digits = sha256(bytes).substr(0, 16);
  std::uint64_t out = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), out, 16);
  return out;
}

/// A number that identifies the layout of a session in memory: of the version above and of the
/// sizes of its parts, in case somebody forgot to raise the version.
std::uint64_t session_layout() {
  static const std::uint64_t out = first_of(fmt::format(
      "{} {} {} {} {} {} {} {} {} {}", kLayoutVersion, sizeof(Session), sizeof(SessionSettings),
      sizeof(Cycle), sizeof(SessionInbox), sizeof(SyncCheck), sizeof(TargetGate), sizeof(ArmWatch),
      sizeof(CorrectionShare), sizeof(SessionReport)));
  return out;
}

std::uint64_t check_of(std::span<const std::byte> copy) {
  return first_of({reinterpret_cast<const char*>(copy.data()), copy.size()});
}

template <class T>
void put_number(CanFrame& frame, std::size_t at, T value) {
  std::memcpy(&frame.data[at], &value, sizeof value);
}

template <class T>
T get_number(const CanFrame& frame, std::size_t at) {
  T out;
  std::memcpy(&out, &frame.data[at], sizeof out);
  return out;
}

constexpr std::size_t kLayoutAt = 0, kCheckAt = 8, kCyclesAt = 16, kModelAt = 24, kSizeAt = 28;
constexpr std::uint8_t kHeadBytes = 32;

}  // namespace

std::string session_lines(std::span<const std::byte> copy, std::uint32_t model,
                          std::uint64_t cycles, std::int64_t time_ns) {
  CanFrame frame{.length = kHeadBytes, .time_ns = time_ns};
  frame.format = CanFrame::Format::kFd;
  put_number(frame, kLayoutAt, session_layout());
  put_number(frame, kCheckAt, check_of(copy));
  put_number(frame, kCyclesAt, cycles);
  put_number(frame, kModelAt, model);
  put_number(frame, kSizeAt, static_cast<std::uint32_t>(copy.size()));
  std::string out = to_line({kStateName, frame}) + "\n";
  for (std::size_t at = 0; at < copy.size(); at += kPart) {
    ++frame.id;
    frame.length = static_cast<std::uint8_t>(std::min(kPart, copy.size() - at));
    std::memcpy(frame.data.data(), copy.data() + at, frame.length);
    out += to_line({kStateName, frame}) + "\n";
  }
  return out;
}

SessionReader::Read SessionReader::take(const CanFrame& frame) {
  if (frame.id == 0 && frame.length == kHeadBytes) {
    foreign_ = get_number<std::uint64_t>(frame, kLayoutAt) != session_layout();
    check_ = get_number<std::uint64_t>(frame, kCheckAt);
    size_ = get_number<std::uint32_t>(frame, kSizeAt);
    session_ = {.model = get_number<std::uint32_t>(frame, kModelAt),
                .cycles = get_number<std::uint64_t>(frame, kCyclesAt),
                .time_ns = frame.time_ns,
                .copy = {}};
    next_ = 1;
    return foreign_ ? Read::kForeign : Read::kGoesOn;
  }
  if (foreign_) return Read::kGoesOn;
  const bool follows = next_ != 0 && frame.id == next_ &&
                       session_.copy.size() + frame.length <= std::min(size_, sizeof(Session));
  if (!follows) {
    next_ = 0;
    return Read::kDamaged;
  }
  ++next_;
  const auto* const bytes = reinterpret_cast<const std::byte*>(frame.data.data());
  session_.copy.insert(session_.copy.end(), bytes, bytes + frame.length);
  if (session_.copy.size() < size_) return Read::kGoesOn;
  next_ = 0;
  return check_of(session_.copy) == check_ ? Read::kComplete : Read::kDamaged;
}

}  // namespace plumb::drivers::rt
