// SPDX-License-Identifier: Apache-2.0
#include "modbus_owner.hpp"

#include <algorithm>
#include <utility>

#include "link_thread.hpp"
#include "modbus_faults.hpp"
#include "plumb/drivers/time_source.hpp"

namespace plumb::drivers {
namespace {

/// Shortest time between two reads of registers that are not about to be written. On a serial line
/// a read takes milliseconds.
constexpr std::int64_t kTcpLook_ns = 1'000'000;
constexpr std::int64_t kSerialLook_ns = 100'000'000;

/// A server is started again once. Registers that are zero after every write are not kept by it, or
/// are zeroed by someone else.
constexpr int kMostZeroed = 2;

bool all_zero(std::span<const std::uint16_t> words) noexcept {
  return std::ranges::all_of(words, [](std::uint16_t word) { return word == 0; });
}

/// The token's registers, as a block among those of the messages.
ModbusBlock block_of_token(std::uint16_t first) {
  return {.kind = {}, .first = first, .count = kOwnerRegisters, .period_s = 1.0};
}

std::array<std::uint16_t, kOwnerRegisters> words_of(std::uint32_t token, ByteOrder order) {
  const auto high = static_cast<std::uint16_t>(token >> 16);
  const auto low = static_cast<std::uint16_t>(token);
  if (order == ByteOrder::kBig) return {high, low};
  return {low, high};
}

}  // namespace

ModbusOwner::ModbusOwner(const BusLayout& layout, const ModbusCodec& codec,
                         const ModbusClientSettings& settings, ModbusTalk& talk,
                         ModbusCounters& counters)
    : talk_(talk),
      counters_(counters),
      look_ns_(std::holds_alternative<SerialLine>(settings.server) ? kSerialLook_ns : kTcpLook_ns),
      watch_ns_(to_ns(settings.watch_s)) {
  std::vector<ModbusBlock> blocks = blocks_of(layout, codec, settings.self);
  if (settings.self == Sender::kPlumb) token_register_ = layout.owner_register;
  if (token_register_) {
    token_ = words_of(settings.token, layout.word_order);
    tokens_.push_back(block_of_token(*token_register_));
    blocks.push_back(tokens_.front());
    std::ranges::sort(blocks, {}, &ModbusBlock::first);
  }
  std::size_t registers = 0;
  for (const ModbusBlock& block : blocks) {
    parts_.push_back({.first = block.first,
                      .count = block.count,
                      .at = registers,
                      .token = token_register_ && block.first == *token_register_});
    registers += block.count;
  }
  confirmed_.resize(registers);
  sent_.resize(registers);
  spans_ = join(blocks, kMostRead, widest_gap(settings));
  looks_.reserve(blocks.size());
}

void ModbusOwner::begin() noexcept {
  looks_.clear();
  for (const ModbusSpan& span : spans_) looks_.push_back({.span = span});
  token_held_ = token_register_.has_value();
  watched_ = watched_ || state_ == State::kWatches;
  state_ = State::kUnseen;
}

bool ModbusOwner::round(std::int64_t now_ns) {
  sight_ = {};
  const bool all = state_ != State::kOwns;
  for (Look& look : looks_) look.fresh = false;
  // A look that is refused is taken off the list, or replaced by several at its end.
  for (std::size_t i = 0; i < looks_.size();) {
    const std::size_t before = looks_.size();
    const std::uint16_t first = looks_[i].span.first;
    if ((all || looks_[i].due_ns <= now_ns) && !look(i, now_ns)) return false;
    const bool same = i < looks_.size() && looks_.size() == before && looks_[i].span.first == first;
    if (same) ++i;
  }
  // A server that lets nothing be read cannot show that it is another's.
  if (looks_.empty()) looked_ns_ = MonotonicTime::now_ns();
  return decide();
}

bool ModbusOwner::look_before(std::uint16_t first, std::uint16_t count, std::int64_t now_ns) {
  bool seen = false;
  for (std::size_t i = 0; i < looks_.size(); ++i) {
    const ModbusSpan& span = looks_[i].span;
    if (span.first >= first + count || first >= span.first + span.count) continue;
    seen = true;
    if (looks_[i].fresh) continue;
    if (!look(i, now_ns)) return false;
    return decide();
  }
  // A server that does not let these be read cannot show that they are another's.
  if (!seen) looked_ns_ = MonotonicTime::now_ns();
  return true;
}

bool ModbusOwner::sight_is_old() const noexcept {
  return MonotonicTime::now_ns() - looked_ns_ > watch_ns_ * 2 / 3;
}

bool ModbusOwner::look(std::size_t index, std::int64_t now_ns) {
  Look& look = looks_[index];
  looked_ns_ = MonotonicTime::now_ns();
  ModbusTalk::Result result = read(look.span);
  if (result == ModbusTalk::Result::kDone && known_ && !all_explained(look.span))
    result = read(look.span);
  if (result == ModbusTalk::Result::kRefused) return handle_refusal(index);
  if (result != ModbusTalk::Result::kDone) return false;
  look.due_ns = now_ns + look_ns_;
  look.fresh = true;
  compare(look.span);
  return true;
}

ModbusTalk::Result ModbusOwner::read(const ModbusSpan& span) {
  return talk_.read(span.first, std::span(found_).first(span.count));
}

/// A server need not have the registers between two messages, nor the token's, nor let what it is
/// given be read.
bool ModbusOwner::handle_refusal(std::size_t index) {
  const bool for_good = talk_.exception() == ModbusException::kIllegalAddress ||
                        talk_.exception() == ModbusException::kIllegalFunction;
  if (!for_good) {
    sight_.complete = false;
    return true;
  }
  const ModbusSpan span = looks_[index].span;
  looks_.erase(looks_.begin() + static_cast<std::ptrdiff_t>(index));
  if (span.blocks.size() > 1)
    for (const ModbusSpan& single : split(span)) looks_.push_back({.span = single});
  else if (part_at(span.first).token)
    token_held_ = false;
  return true;
}

ModbusOwner::Part& ModbusOwner::part_at(std::uint16_t first) noexcept {
  return *std::ranges::find(parts_, first, &Part::first);
}

bool ModbusOwner::is_explained(const Part& part, Words found) const noexcept {
  for (std::size_t i = 0; i < part.count; ++i)
    if (found[i] != confirmed_[part.at + i] && found[i] != sent_[part.at + i]) return false;
  return true;
}

bool ModbusOwner::all_explained(const ModbusSpan& span) noexcept {
  return std::ranges::all_of(span.blocks, [&](const ModbusBlock& block) {
    return is_explained(part_at(block.first),
                        std::span(found_).subspan(block.first - span.first, block.count));
  });
}

void ModbusOwner::compare(const ModbusSpan& span) noexcept {
  for (const ModbusBlock& block : span.blocks) {
    const Words found = std::span(found_).subspan(block.first - span.first, block.count);
    Part& part = part_at(block.first);
    const Verdict verdict = judge(part, found);
    sight_.in_use = sight_.in_use || !all_zero(found);
    sight_.foreign += verdict == Verdict::kForeign ? 1 : 0;
    sight_.zeroed += verdict == Verdict::kZeroed ? 1 : 0;
    if (part.token) {
      sight_.token_foreign = verdict == Verdict::kForeign;
      sight_.token = std::ranges::equal(found, token_) ? Sight::Token::kOurs : Sight::Token::kOther;
    }
    adopt(part, found);
  }
}

ModbusOwner::Verdict ModbusOwner::judge(Part& part, Words found) noexcept {
  if (!known_) return Verdict::kExplained;
  if (is_explained(part, found)) {
    if (!all_zero(found)) part.zeroed = 0;
    return Verdict::kExplained;
  }
  if (!all_zero(found)) return Verdict::kForeign;
  return ++part.zeroed <= kMostZeroed ? Verdict::kZeroed : Verdict::kForeign;
}

/// What was found is what the next look must find, so that every foreign write counts once.
void ModbusOwner::adopt(const Part& part, Words found) noexcept {
  std::ranges::copy(found, confirmed_.begin() + static_cast<std::ptrdiff_t>(part.at));
  std::ranges::copy(found, sent_.begin() + static_cast<std::ptrdiff_t>(part.at));
}

/// Judges the sights of this round. Returns false if the connection can no longer be used.
bool ModbusOwner::decide() {
  const bool first_sight = state_ == State::kUnseen;
  if (first_sight && !sight_.complete) return true;
  const bool at_start = !known_;
  known_ = true;
  if (sight_.foreign > 0) talk_.note_unclean();
  if (state_ == State::kWatches) {
    talk_.note_unclean();
    if (sight_.foreign > 0) {
      ++counters_.foreign_senders;
      quiet_since_ns_ = MonotonicTime::now_ns();
    }
    const bool rest = looked_ns_ - quiet_since_ns_ >= watch_ns_ && !sight_is_old();
    return !rest || claim();
  }
  // What it watched has not changed while there was no connection: the other one had none either.
  if (first_sight && std::exchange(watched_, false)) {
    if (sight_.foreign > 0) ++counters_.foreign_senders;
    watch();
    return true;
  }
  if (first_sight && at_start) {
    if (!sight_.in_use) return claim();
    watch();
    return true;
  }
  if (first_sight && sight_.foreign > 0) {
    // It may be from before, kept by a controller that was switched off: if it is alive, it shows.
    ++counters_.restarts;
    watch();
    return true;
  }
  if (sight_.foreign > 0) ++counters_.foreign_senders;
  if (sight_.token_foreign) {
    watch();
    return true;
  }
  if (sight_.zeroed > 0) ++counters_.restarts;
  if (token_held_ && sight_.token == Sight::Token::kOther) return claim();
  const bool unsure = token_held_ && sight_.token == Sight::Token::kUnseen;
  if (!(unsure && state_ == State::kClaims)) state_ = State::kOwns;
  return true;
}

/// The time of the round may be from before the process was stopped: the clock is read.
void ModbusOwner::watch() noexcept {
  talk_.note_unclean();
  state_ = State::kWatches;
  quiet_since_ns_ = MonotonicTime::now_ns();
}

/// Writes the token, which the next round must find before anything else is written. A refusal for
/// the moment leaves the claim open: without a token two clients would both take themselves for the
/// owner.
bool ModbusOwner::claim() {
  state_ = token_held_ ? State::kClaims : State::kOwns;
  if (!token_held_) return true;
  write_begins(*token_register_, token_);
  const ModbusTalk::Result result = talk_.write(*token_register_, token_);
  if (result == ModbusTalk::Result::kDone) {
    write_done(*token_register_, token_);
    refusals_.taken(0);
  }
  if (result == ModbusTalk::Result::kRefused) {
    const ModbusException why = talk_.exception();
    if (why == ModbusException::kIllegalFunction || why == ModbusException::kIllegalAddress ||
        why == ModbusException::kIllegalValue) {
      token_held_ = false;
      state_ = State::kOwns;
    } else {
      ++counters_.refused_writes;
      refusals_.refused(0, static_cast<std::uint32_t>(why), MonotonicTime::now_ns());
    }
  }
  return ModbusTalk::goes_on(result);
}

template <class Do>
void ModbusOwner::for_written(std::uint16_t first, Words content, Do act) noexcept {
  for (const Part& part : parts_) {
    if (part.first < first || part.first + part.count > first + static_cast<int>(content.size()))
      continue;
    act(part, content.subspan(part.first - first, part.count));
  }
}

void ModbusOwner::write_begins(std::uint16_t first, Words content) noexcept {
  for_written(first, content, [this](const Part& part, Words words) {
    std::ranges::copy(words, sent_.begin() + static_cast<std::ptrdiff_t>(part.at));
  });
}

void ModbusOwner::write_done(std::uint16_t first, Words content) noexcept {
  for_written(first, content, [this](const Part& part, Words words) {
    std::ranges::copy(words, confirmed_.begin() + static_cast<std::ptrdiff_t>(part.at));
  });
}

}  // namespace plumb::drivers
