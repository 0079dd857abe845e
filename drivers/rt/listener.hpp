// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "plumb/drivers/descriptor.hpp"

namespace plumb::drivers::rt {

/// Limits for a peer: the length of a request, and the time [ms] within which the request must be
/// complete and its answer be read.
struct Patience {
  std::size_t most_bytes = 4096;
  int within_ms = 100;
};

/// If a connection waits at `listening`: accepts it, reads a request up to `end_of_request`, writes
/// the result of `answer`, and closes. A peer that exceeds the limits gets no answer.
void serve_one(int listening, const std::string& end_of_request, const Patience& patience,
               const std::function<std::string(const std::string&)>& answer);

/// Listens on a Unix domain socket that only its owner may use. Empty on failure, with errno.
std::optional<Descriptor> listen_unix(const std::filesystem::path& path);

/// Listens on 127.0.0.1. Empty on failure, with errno.
std::optional<Descriptor> listen_loopback(std::uint16_t port);

/// Sends a request over a Unix domain socket and returns the whole answer. Empty if nobody
/// listens, or without an answer within `within_ms`.
std::optional<std::string> ask(const std::filesystem::path& path, const std::string& request,
                               int within_ms);

}  // namespace plumb::drivers::rt
