// SPDX-License-Identifier: Apache-2.0
#include "rt/record_text.hpp"

#include "plumb/drivers/time_source.hpp"
#include "rt/record_line.hpp"
#include "rt/session_lines.hpp"

namespace plumb::drivers::rt {

std::string RecordText::start(const SessionStart& start) {
  return to_line({kStartName, start_frame(start, MonotonicTime::now_ns())}) + "\n";
}

std::string RecordText::entry(const RecordEntry& entry, std::span<const std::byte> copy) {
  using What = RecordEntry::What;
  if (entry.what == What::kTick) {
    last_ns_ = entry.tick.now_ns;
    return to_line({kTickName, tick_frame({entry.tick, entry.model})}) + "\n";
  }
  if (entry.what == What::kState)
    return session_lines(copy, entry.model, entry.cycles, entry.tick.now_ns);
  std::string out;
  for (CanFrame frame : codec_.encode(entry.message)) {
    frame.time_ns = entry.message.time_ns;
    out += to_line({entry.what == What::kNotSent ? kUnsentName : bus_, frame}) + "\n";
  }
  return out;
}

std::string RecordText::gap(std::uint64_t entries) const {
  CanFrame frame{.length = 8, .time_ns = last_ns_};
  for (unsigned i = 0; i < 8; ++i) frame.data[i] = static_cast<std::uint8_t>(entries >> (8 * i));
  return to_line({kGapName, frame}) + "\n";
}

}  // namespace plumb::drivers::rt
