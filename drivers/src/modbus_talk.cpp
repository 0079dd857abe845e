// SPDX-License-Identifier: Apache-2.0
#include "modbus_talk.hpp"

namespace plumb::drivers {

void ModbusTalk::begin(std::unique_ptr<ModbusConnection> connection, Met answered) noexcept {
  connection_ = std::move(connection);
  met_ = false;
  if (answered == Met::kYes) met();
}

void ModbusTalk::end() noexcept {
  connection_.reset();
  ++counters_.disconnects;
}

ModbusTalk::Result ModbusTalk::read(std::uint16_t first, std::span<std::uint16_t> registers) {
  return counted(connection_->read(first, registers));
}

ModbusTalk::Result ModbusTalk::write(std::uint16_t first,
                                     std::span<const std::uint16_t> registers) {
  return counted(connection_->write(first, registers));
}

ModbusTalk::Result ModbusTalk::counted(Result result) noexcept {
  if (goes_on(result)) met();
  switch (result) {
    case Result::kDone:
      ++counters_.transactions;
      break;
    case Result::kRefused:
      ++counters_.refusals;
      note_unclean();
      break;
    case Result::kLate:
      ++counters_.timeouts;
      break;
    case Result::kBad:
      ++counters_.bad_frames;
      break;
    case Result::kLost:
      break;
  }
  return result;
}

void ModbusTalk::met() noexcept {
  if (!met_) ++counters_.connects;
  met_ = true;
}

}  // namespace plumb::drivers
