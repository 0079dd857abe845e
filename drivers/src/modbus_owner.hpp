// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "modbus_spans.hpp"
#include "modbus_talk.hpp"
#include "write_refusals.hpp"

namespace plumb::drivers {

/// A client's watch over the registers of a server into which it writes: they are the client's
/// alone.
///
/// Before every write, and every millisecond in between, the registers are read and compared with
/// what was written last. A write that was not confirmed may have arrived or not. Registers that
/// became zero are those of a server that was started again. Anything else was written by someone
/// else: a foreign sender. A difference is read a second time before it counts.
///
/// Where the layout has a register for it, the client writes a random number there, its token, and
/// reads it back before it writes anything else. A client that finds registers in use at its first
/// sight of them, or another token at a later one, only watches; it takes them when they have not
/// changed for a while. A server that has no such register says so (illegal function, address or
/// value), and the client goes on without a token; one that refuses it for the moment is asked
/// again.
///
/// Heap: in the constructor, and when a server refuses registers. Thread: one.
class ModbusOwner {
 public:
  ModbusOwner(const BusLayout& layout, const ModbusCodec& codec,
              const ModbusClientSettings& settings, ModbusTalk& talk, ModbusCounters& counters);

  /// Starts with a new connection: nothing is written before all registers were seen.
  void begin() noexcept;

  /// Compares the registers that are due. Returns false if the connection can no longer be used.
  bool round(std::int64_t now_ns);

  /// Compares the registers around these, unless round() did so just before.
  bool look_before(std::uint16_t first, std::uint16_t count, std::int64_t now_ns);

  /// The token's registers, if the server has refused them for a while; else nothing.
  WriteRefusal refusal(std::int64_t now_ns) noexcept { return refusals_.find(tokens_, now_ns); }

  /// False: the registers are not ours, or someone else has just written into them.
  bool may_write() const noexcept { return state_ == State::kOwns && sight_.foreign == 0; }

  /// Whether the last look began so long ago that another client may have taken the registers
  /// since: the process was stopped between look and write. Nothing is to be written then.
  bool sight_is_old() const noexcept;

  /// To be called before registers are written, and again when the server has confirmed it.
  void write_begins(std::uint16_t first, std::span<const std::uint16_t> content) noexcept;
  void write_done(std::uint16_t first, std::span<const std::uint16_t> content) noexcept;

 private:
  enum class State : std::uint8_t { kUnseen, kWatches, kClaims, kOwns };

  /// The registers of a message or of the token. Each may hold what the last confirmed write left
  /// there, or what a later write contained whose answer did not come.
  struct Part {
    std::uint16_t first = 0;
    std::uint16_t count = 0;
    std::size_t at = 0;  // in confirmed_ and sent_
    bool token = false;
    int zeroed = 0;  // how often in a row it was found to be zero after a write
  };

  struct Look {
    ModbusSpan span;
    std::int64_t due_ns = 0;
    bool fresh = false;  // read in this round
  };

  /// What was seen in this round.
  struct Sight {
    int foreign = 0;
    int zeroed = 0;
    bool in_use = false;  // a register is not zero
    enum class Token : std::uint8_t { kUnseen, kOurs, kOther } token = Token::kUnseen;
    bool token_foreign = false;  // it is another, and was ours before
    bool complete = true;        // nothing was refused for the moment
  };

  using Words = std::span<const std::uint16_t>;
  enum class Verdict : std::uint8_t { kExplained, kZeroed, kForeign };

  void add_look(const ModbusSpan& span);
  bool look(std::size_t index, std::int64_t now_ns);
  ModbusTalk::Result read(const ModbusSpan& span);
  bool handle_refusal(std::size_t index);
  Part& part_at(std::uint16_t first) noexcept;
  bool is_explained(const Part& part, Words found) const noexcept;
  bool all_explained(const ModbusSpan& span) noexcept;
  void compare(const ModbusSpan& span) noexcept;
  Verdict judge(Part& part, Words found) noexcept;
  void adopt(const Part& part, Words found) noexcept;
  bool decide();
  void watch() noexcept;
  bool claim();
  template <class Do>
  void for_written(std::uint16_t first, Words content, Do act) noexcept;

  ModbusTalk& talk_;
  ModbusCounters& counters_;
  std::int64_t looked_ns_ = 0;  // when the last look began
  std::int64_t look_ns_;
  std::int64_t watch_ns_;
  std::vector<ModbusSpan> spans_;  // of a server that refuses nothing
  std::vector<Look> looks_;
  std::vector<Part> parts_;
  std::vector<std::uint16_t> confirmed_;
  std::vector<std::uint16_t> sent_;
  std::array<std::uint16_t, kMostRead> found_{};
  std::optional<std::uint16_t> token_register_;
  std::vector<ModbusBlock> tokens_;  // the block of the token, if there is one
  WriteRefusals refusals_{1};        // of it
  std::array<std::uint16_t, kOwnerRegisters> token_{};
  bool token_held_ = false;  // the server has the token's register
  bool known_ = false;       // the registers were seen before, on this connection or an earlier one
  State state_ = State::kUnseen;
  Sight sight_;
  std::int64_t quiet_since_ns_ = 0;
  bool watched_ = false;  // when the connection was lost: with the next one the watch begins anew
};

}  // namespace plumb::drivers
