// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "workbench/request.hpp"
#include "workbench/response.hpp"

namespace plumb::offline::workbench {

/// HTTP and WebSockets on 127.0.0.1. Bounds: 32 connections, the next one gets 503; 16 kB of
/// headers; bodies as `most_body` says; 30 s for a request to arrive and for an answer to be taken,
/// after which the connection is cut; so is a WebSocket whose reader lags behind 64 messages.
class Server {
 public:
  /// Listens; port 0: any that is free. Throws Failure (kEnvironment, E-SERVE-PORT).
  explicit Server(int port);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  int port() const;

  struct Answers {
    std::function<Response(const Request&)> answer;  // of a whole request; called from threads
    std::function<std::optional<Response>(const Request&)> refuse;         // from its head alone
    std::function<std::optional<Response>(const Request&)> refuse_socket;  // of a WebSocket
    std::function<std::string()> greeting;  // the first message of a WebSocket
    std::function<void()> stopping;         // called before the last answers are waited for
  };

  /// Serves until SIGINT or SIGTERM.
  void run(Answers answers);

  /// Sends a text to every WebSocket. From any thread, while or before `run` runs.
  void broadcast(std::string message);

 private:
  class Hub;
  std::unique_ptr<Hub> hub_;
};

}  // namespace plumb::offline::workbench
