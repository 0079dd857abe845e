// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "plumb/drivers/descriptor.hpp"
#include "rt/reserve_descriptor.hpp"

namespace plumb::drivers::rt {

/// Limits for a peer: the length of a request, and the time [ms] within which the request must be
/// complete and its answer be read.
struct Patience {
  std::size_t most_bytes = 4096;
  int within_ms = 100;
};

/// A request, and the connection that waits for its answer.
struct Asked {
  Descriptor peer;
  std::string request;
  std::int64_t uid = -1;  // user of the peer's process, over a Unix domain socket; else -1
};

/// If a connection waits at `listening`: accepts it and reads a request up to `end_of_request`.
/// Nothing if there is none, or if the peer exceeds the limits. `reserve` is given up if no other
/// descriptor is left for the connection.
std::optional<Asked> take_request(int listening, ReserveDescriptor& reserve,
                                  const std::string& end_of_request, const Patience& patience);

/// Writes the answer, as far as the peer reads it in time.
void reply_to(const Descriptor& peer, const std::string& answer, const Patience& patience);

/// If a connection waits at `listening`: accepts it, reads a request up to `end_of_request`, writes
/// the result of `answer`, and closes. A peer that exceeds the limits gets no answer.
void serve_one(int listening, ReserveDescriptor& reserve, const std::string& end_of_request,
               const Patience& patience,
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
