// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "plumb/drivers/can_codec.hpp"
#include "plumb/drivers/record_ring.hpp"

namespace plumb::drivers::rt {

/// Puts what the cycle received and sent into lines of candump's format (record_line.hpp).
class RecordText {
 public:
  RecordText(const BusLayout& layout, std::string bus) : codec_(layout), bus_(std::move(bus)) {}

  /// The first line of a run.
  std::string start(const SessionStart& start);

  /// Whole lines for an entry; `copy`: of the session, for kState.
  std::string entry(const RecordEntry& entry, std::span<const std::byte> copy);

  /// A line that says that so many entries are missing here.
  std::string gap(std::uint64_t entries) const;

 private:
  CanCodec codec_;
  std::string bus_;
  std::int64_t last_ns_ = 0;  // time of the last step
};

}  // namespace plumb::drivers::rt
