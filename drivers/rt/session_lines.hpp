// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "plumb/drivers/can_frame.hpp"

namespace plumb::drivers::rt {

/// A copy of the session's memory in a record, from which a replay can begin.
struct RecordedSession {
  std::uint32_t model = 0;   // number of the model that it used last
  std::uint64_t cycles = 0;  // its steps so far
  std::int64_t time_ns = 0;  // of the last one
  std::vector<std::byte> copy;
};

/// Lines named `state`: a head with the layout of sessions in this program and a check sum, then
/// the copy in frames of 64 bytes.
std::string session_lines(std::span<const std::byte> copy, std::uint32_t model,
                          std::uint64_t cycles, std::int64_t time_ns);

/// Puts the lines together again.
class SessionReader {
 public:
  enum class Read : std::uint8_t {
    kGoesOn,
    kComplete,
    kDamaged,  // frames are missing, twice, or the check sum is wrong
    kForeign,  // by a program in which sessions have another layout
  };
  Read take(const CanFrame& frame);
  const RecordedSession& session() const noexcept { return session_; }  // after kComplete

 private:
  RecordedSession session_;
  std::size_t size_ = 0;
  std::uint64_t check_ = 0;
  std::uint32_t next_ = 0;  // identifier of the frame that is to come; 0: a head
  bool foreign_ = false;
};

}  // namespace plumb::drivers::rt
