// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

namespace plumb::offline {

/// "192.168.0.10:1502" as host and port. Without a port, or with more than one colon, as in an IPv6
/// address, the whole is the host and the port is empty.
inline std::pair<std::string, std::string> host_and_port(const std::string& address) {
  const auto colon = address.find(':');
  if (colon == std::string::npos || address.find(':', colon + 1) != std::string::npos)
    return {address, ""};
  return {address.substr(0, colon), address.substr(colon + 1)};
}

}  // namespace plumb::offline
