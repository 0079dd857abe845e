// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "workbench/request.hpp"
#include "workbench/response.hpp"

namespace plumb::offline::workbench {

/// Who may ask: a page of this very server, and for what writes one that knows its token.
struct Access {
  int port = 0;
  std::string token;
};

inline constexpr std::size_t kMostJsonBytes = std::size_t{1} << 20;  // of a body that is JSON
inline constexpr std::size_t kMostUpload = std::size_t{16} << 20;    // of a body that is a file
inline constexpr std::size_t kMostHeaderBytes = std::size_t{16} << 10;

/// Why a request is not even looked at, decided from its head alone; nothing if it is: a Host that
/// is not this server (a foreign name that was made to lead here), an Origin that is another page,
/// a method that the server does not know, or something that writes without the token.
std::optional<Response> refusal(const Request& head, const Access& access);

/// The same of a WebSocket, which always needs the token.
std::optional<Response> socket_refusal(const Request& head, const Access& access);

/// How large the body of this request may be [bytes].
std::size_t most_body(const Request& head);

/// 128 random bits as 32 hex digits.
std::string new_token();

/// Whether two texts are equal, in a time that does not say where they differ.
bool equal_in_constant_time(const std::string& a, const std::string& b);

}  // namespace plumb::offline::workbench
