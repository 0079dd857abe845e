// SPDX-License-Identifier: Apache-2.0
#include "modbus_serial_listener.hpp"

#include <poll.h>

#include <algorithm>
#include <cerrno>

#include "plumb/drivers/time_source.hpp"

namespace plumb::drivers {
namespace {

constexpr std::int64_t kOpenAgain_ns = 200'000'000;  // pause before a lost device is opened again
constexpr std::uint64_t kThePeer = 1;                // there is one master on a line
constexpr std::size_t kCheckSum = 2;

}  // namespace

void ModbusSerialListener::run(const LinkThread& thread) {
  const auto& line = std::get<SerialLine>(settings_.at);
  do {
    const ModbusContext context = open_serial(line, settings_.unit, settings_.request_timeout_s);
    if (!context) continue;
    ++exchange_->counters.connects;
    serve(context.get(), thread);
    exchange_->state = LinkState::kDown;
    ++exchange_->counters.disconnects;
  } while (thread.sleep_until_ns(MonotonicTime::now_ns() + kOpenAgain_ns));
}

void ModbusSerialListener::serve(modbus_t* context, const LinkThread& thread) {
  const int line = ::modbus_get_socket(context);
  while (await_request(line, thread))
    if (serve_request(context) == Line::kBroken) return;
}

/// Waits for a request. Returns false if the line is broken or the thread shall stop.
bool ModbusSerialListener::await_request(int line, const LinkThread& thread) {
  std::array<pollfd, 2> events{pollfd{.fd = line, .events = POLLIN, .revents = 0},
                               pollfd{.fd = thread.stop_event(), .events = POLLIN, .revents = 0}};
  while (!thread.stopping()) {
    const timespec wait = wait_until(MonotonicTime::now_ns() + to_ns(settings_.idle_timeout_s));
    const int ready = ::ppoll(events.data(), events.size(), &wait, nullptr);
    if (ready > 0 && (events[0].revents & POLLIN) != 0) return !thread.stopping();
    if (ready > 0 && events[0].revents != 0) return false;
    if (ready == 0) exchange_->state = LinkState::kDown;
  }
  return false;
}

ModbusSerialListener::Line ModbusSerialListener::serve_request(modbus_t* context) {
  std::array<std::uint8_t, MODBUS_MAX_ADU_LENGTH> frame;
  const int size = ::modbus_receive(context, frame.data());
  if (size > 0) return answer(context, std::span(frame).first(static_cast<std::size_t>(size)));
  if (size == 0) return Line::kGood;  // the request was for another unit
  if (errno == ETIMEDOUT) {
    ++exchange_->counters.timeouts;
  } else if (errno > MODBUS_ENOBASE) {
    ++exchange_->counters.bad_frames;
  } else {
    return Line::kBroken;
  }
  ::modbus_flush(context);
  return Line::kGood;
}

ModbusSerialListener::Line ModbusSerialListener::answer(modbus_t* context,
                                                        std::span<const std::uint8_t> frame) {
  if (frame.size() < 2 + kCheckSum || frame[0] != settings_.unit) return Line::kGood;
  const auto pdu = service_->answer(frame.subspan(1, frame.size() - 1 - kCheckSum), kThePeer,
                                    MonotonicTime::now_ns());
  std::array<std::uint8_t, 1 + kMostPdu> reply;
  reply[0] = settings_.unit;
  std::ranges::copy(pdu, reply.begin() + 1);
  const int size = static_cast<int>(1 + pdu.size());
  exchange_->state = LinkState::kUp;
  return ::modbus_send_raw_request(context, reply.data(), size) ==
                 size + static_cast<int>(kCheckSum)
             ? Line::kGood
             : Line::kBroken;
}

}  // namespace plumb::drivers
