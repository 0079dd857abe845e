// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "plumb/drivers/descriptor.hpp"

namespace plumb::drivers::rt {

/// How much of a peer is borne: a request has a length and a time in which it must be whole, and
/// its answer a time in which it must be taken.
struct Patience {
  std::size_t most_bytes = 4096;
  int within_ms = 100;
};

/// Answers one request of a connection that waits at `listening`, if one does: reads up to
/// `end_of_request`, writes what `answer` makes of it, and closes. Who is slow or says too much is
/// left without an answer.
void serve_one(int listening, const std::string& end_of_request, const Patience& patience,
               const std::function<std::string(const std::string&)>& answer);

/// Listens on a Unix domain socket that only its owner may use. None: errno says why.
std::optional<Descriptor> listen_unix(const std::filesystem::path& path);

/// Listens on 127.0.0.1. None: errno says why.
std::optional<Descriptor> listen_loopback(std::uint16_t port);

/// Sends a request over a Unix domain socket and returns the whole answer; none: nobody listens,
/// or no answer within `within_ms`.
std::optional<std::string> ask(const std::filesystem::path& path, const std::string& request,
                               int within_ms);

}  // namespace plumb::drivers::rt
