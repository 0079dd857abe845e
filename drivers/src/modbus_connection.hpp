// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <modbus/modbus.h>

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "link_thread.hpp"
#include "plumb/drivers/modbus_frame.hpp"
#include "plumb/drivers/modbus_settings.hpp"

namespace plumb::drivers {

struct ModbusClosed {
  void operator()(modbus_t* context) const noexcept {
    ::modbus_close(context);
    ::modbus_free(context);
  }
};
using ModbusContext = std::unique_ptr<modbus_t, ModbusClosed>;

/// Opens a serial line; null on failure, with the reason in errno. `timeout_s` limits the wait for
/// a whole frame. No limit is set between bytes, because libmodbus would use it in place of the
/// limit for the frame.
ModbusContext open_serial(const SerialLine& line, int unit, double timeout_s);

/// One connection of a client, which lasts until its first error.
///
/// Answers are read with libmodbus. It would accept a wrong unit, protocol, length or echo of a
/// write, and modbus_send_raw_request does not number transactions. Therefore the header of TCP
/// requests is written here, and every field of an answer is checked here. libmodbus aborts on
/// descriptors of FD_SETSIZE or above, so these are refused.
class ModbusConnection {
 public:
  enum class Result : std::uint8_t {
    kDone,
    kRefused,  // a valid exception answer
    kLate,     // no complete answer in time
    kBad,      // an answer that does not belong to the request, or unrequested bytes
    kLost,     // the peer, or the serial device, is gone
  };

  /// Null on failure, with the reason in errno: ECANCELED if the thread shall stop.
  static std::unique_ptr<ModbusConnection> open(const ModbusClientSettings& settings,
                                                const LinkThread& thread);

  Result read(std::uint16_t first, std::span<std::uint16_t> registers);         // <= kMostRead
  Result write(std::uint16_t first, std::span<const std::uint16_t> registers);  // <= kMostWrite

  /// The code of the last exception answer.
  ModbusException exception() const noexcept { return ModbusException{answer_pdu_[1]}; }

 private:
  ModbusConnection(ModbusContext context, std::uint8_t unit, bool tcp)
      : context_(std::move(context)), unit_(unit), tcp_(tcp) {}

  bool unasked_bytes() const;
  bool send_request(std::size_t pdu_size);
  Result exchange(std::size_t pdu_size);
  bool is_framed_well(std::size_t size) const;

  ModbusContext context_;
  std::uint8_t unit_;
  bool tcp_;
  std::uint16_t transaction_ = 0;
  std::array<std::uint8_t, kMostTcpFrame> request_{};
  std::array<std::uint8_t, MODBUS_MAX_ADU_LENGTH> answer_{};
  std::span<const std::uint8_t> answer_pdu_;
};

}  // namespace plumb::drivers
