// SPDX-License-Identifier: Apache-2.0
#include "workbench/access.hpp"

#include <fmt/format.h>
#include <sys/random.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "workbench/target.hpp"

namespace plumb::offline::workbench {
namespace {

/// "127.0.0.1:PORT" or "localhost:PORT".
bool is_here(std::string host, int port) {
  std::transform(host.begin(), host.end(), host.begin(), [](char c) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  });
  return host == fmt::format("127.0.0.1:{}", port) || host == fmt::format("localhost:{}", port);
}

std::optional<Response> foreign(const Request& head, int port) {
  if (!is_here(head.host, port))
    return error_response(
        403, {.code = "E-SERVE-HOST",
              .message = "the request names another host than this server",
              .help = fmt::format("open http://127.0.0.1:{}/ as plumb serve printed it", port)});
  if (head.origin.empty()) return std::nullopt;
  if (head.origin.starts_with("http://") && is_here(head.origin.substr(7), port))
    return std::nullopt;
  return error_response(403, {.code = "E-SERVE-ORIGIN",
                              .message = "the request comes from the page of another server",
                              .help = "use the page that plumb serve opens"});
}

std::optional<Response> without_token(const std::string& token, const Access& access) {
  if (equal_in_constant_time(token, access.token)) return std::nullopt;
  return error_response(403, {.code = "E-SERVE-TOKEN",
                              .message = "this needs the token of the running server",
                              .help = "open the address that plumb serve printed, with its token"});
}

}  // namespace

bool equal_in_constant_time(const std::string& a, const std::string& b) {
  unsigned differ = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i)
    differ |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  return differ == 0;
}

std::optional<Response> refusal(const Request& head, const Access& access) {
  if (auto out = foreign(head, access.port)) return out;
  if (head.method == "GET") return std::nullopt;
  if (head.method == "POST" || head.method == "PUT" || head.method == "DELETE")
    return without_token(head.token, access);
  return error_response(405, {.code = "E-SERVE-METHOD",
                              .message = "the server knows GET, POST, PUT and DELETE",
                              .help = "docs/workbench.md lists what it answers"});
}

std::optional<Response> socket_refusal(const Request& head, const Access& access) {
  if (auto out = foreign(head, access.port)) return out;
  const auto target = parse_target(head.target);
  const auto token = target ? target->query.find("token") : decltype(target->query.end()){};
  if (!target || target->path != std::vector<std::string>{"api", "ws"})
    return error_response(404, {.code = "E-SERVE-PATH",
                                .message = "there is no WebSocket at this path",
                                .help = "it is at /api/ws"});
  return without_token(token == target->query.end() ? "" : token->second, access);
}

std::size_t most_body(const Request& head) {
  if (head.method == "GET" || head.method == "DELETE") return 0;
  const bool is_file = head.method == "PUT" && head.target.starts_with("/api/files/");
  return is_file ? kMostUpload : kMostJsonBytes;
}

std::string new_token() {
  std::array<unsigned char, 16> random{};
  if (::getrandom(random.data(), random.size(), 0) != static_cast<ssize_t>(random.size()))
    throw Failure(Exit::kEnvironment, {.code = "E-SERVE-RANDOM",
                                       .message = "the system gives no random numbers",
                                       .help = "ls -l /dev/urandom"});
  std::string out;
  for (const unsigned char byte : random) out += fmt::format("{:02x}", byte);
  return out;
}

}  // namespace plumb::offline::workbench
