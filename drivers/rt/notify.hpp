// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace plumb::drivers::rt {

/// Reports the state of the program to the service manager over the socket in NOTIFY_SOCKET
/// (sd_notify(3)). Does nothing if there is no such socket. Never blocks, never fails.
class ServiceManager {
 public:
  ServiceManager();
  ~ServiceManager();
  ServiceManager(const ServiceManager&) = delete;
  ServiceManager& operator=(const ServiceManager&) = delete;

  /// "READY=1", "WATCHDOG=1", "STOPPING=1", "STATUS=..."
  void tell(const std::string& state) noexcept;

  /// Half of WATCHDOG_USEC [ns]; 0 if there is no watchdog.
  std::int64_t watchdog_ns() const noexcept { return watchdog_ns_; }

 private:
  int fd_ = -1;
  std::int64_t watchdog_ns_ = 0;
};

}  // namespace plumb::drivers::rt
