// SPDX-License-Identifier: Apache-2.0
#include "modbus_faults.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>

#include "plumb/drivers/modbus_frame.hpp"

namespace plumb::drivers {
namespace {

using Fault = std::optional<LinkFault>;

// libmodbus would silently replace any other rate by 9600.
constexpr std::array kBauds{1200,  2400,   4800,   9600,   19200,  38400,
                            57600, 115200, 230400, 460800, 921600, 1000000};

Fault find_fault(const SerialLine& line, int unit) {
  if (std::find(kBauds.begin(), kBauds.end(), line.baud) == kBauds.end())
    return LinkFault{"baud", "no serial line runs at " + std::to_string(line.baud) + " baud",
                     "use one of 9600, 19200, 38400, 57600, 115200, 230400, 460800, 921600"};
  if (line.stop_bits != 1 && line.stop_bits != 2)
    return LinkFault{"stop_bits", "a serial line has 1 or 2 stop bits", "set it to 1"};
  if (unit < 1 || unit > 247)
    return LinkFault{"unit", "on a serial line unit " + std::to_string(unit) + " is reserved",
                     "set it to 1 .. 247"};
  const int device = ::open(line.device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (device < 0)
    return LinkFault{
        "device", "cannot open " + line.device + ": " + std::strerror(errno),
        errno == EACCES ? "add the user to the group of the device" : "ls -l /dev/serial/by-id",
        errno};
  const bool terminal = ::isatty(device) == 1;
  ::close(device);
  if (!terminal)
    return LinkFault{"device", line.device + " is not a serial device", "ls -l /dev/serial/by-id"};
  return std::nullopt;
}

Fault find_time(const char* key, double value_s) {
  if (std::isfinite(value_s) && value_s >= 1e-3 && value_s <= 60) return std::nullopt;
  return LinkFault{key, std::string(key) + " is not a time of 1 ms to 60 s", "leave it out"};
}

Fault not_an_address(const std::string& key, const std::string& host) {
  return LinkFault{key, "'" + host + "' is not an address in numbers",
                   "write it as in 192.168.0.7, or as in fd00::7"};
}

}  // namespace

Fault find_fault(const ModbusClientSettings& settings) {
  for (auto [key, value_s] :
       {std::pair{"response_timeout", settings.response_timeout_s},
        std::pair{"first_back_off", settings.first_back_off_s},
        std::pair{"longest_back_off", settings.longest_back_off_s},
        std::pair{"stale_after", settings.stale_after_s}, std::pair{"watch", settings.watch_s}})
    if (auto fault = find_time(key, value_s)) return fault;
  if (const auto* line = std::get_if<SerialLine>(&settings.server))
    return find_fault(*line, settings.unit);
  const auto& tcp = std::get<TcpAddress>(settings.server);
  if (!socket_address(tcp.host, tcp.port)) return not_an_address("host", tcp.host);
  if (tcp.port == 0) return LinkFault{"port", "no server listens on port 0", "use 502"};
  return std::nullopt;
}

Fault find_fault(const ModbusServerSettings& settings) {
  for (auto [key, value_s] : {std::pair{"request_timeout", settings.request_timeout_s},
                              std::pair{"idle_timeout", settings.idle_timeout_s},
                              std::pair{"stale_after", settings.stale_after_s},
                              std::pair{"writer_hold", settings.writer_hold_s}})
    if (auto fault = find_time(key, value_s)) return fault;
  if (const auto* line = std::get_if<SerialLine>(&settings.at))
    return find_fault(*line, settings.unit);
  if (settings.peers.empty())
    return LinkFault{"peers", "no peer is named, so whoever reaches the port could send targets",
                     "name the address of the controller, as in 192.168.0.10"};
  for (const auto& peer : settings.peers)
    if (!socket_address(peer, 0)) return not_an_address("peers", peer);
  if (settings.most_connections < 1 || settings.most_connections > 64)
    return LinkFault{"connections", "a server has 1 to 64 connections", "leave it out"};
  return std::nullopt;
}

int widest_gap(const ModbusClientSettings& settings) {
  return std::holds_alternative<TcpAddress>(settings.server) ? int{kMostRead} : 0;
}

LinkFault cannot_run(int error) {
  return {"", std::string("no thread for the link: ") + std::strerror(error),
          "raise the limits of processes and open files (ulimit -u, ulimit -n)", error};
}

}  // namespace plumb::drivers
