// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <poll.h>

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "program/folder_lock.hpp"
#include "rt/listener.hpp"
#include "rt/place.hpp"

namespace plumb::tests {

/// A plumb-rt that runs a place, as others see it: a thread that holds the lock of the place and
/// answers on its socket.
class FakeRun {
 public:
  using Answer = std::function<std::string(const std::string& request)>;

  FakeRun(const drivers::rt::InstallPlace& place, Answer answer)
      : lock_(place.folder),
        listening_(listen_anew(place.folder / "plumb-rt.sock")),
        thread_([this, answer = std::move(answer)] { run(answer); }) {}
  /// Answers every request with the same text.
  FakeRun(const drivers::rt::InstallPlace& place, std::string answer)
      : FakeRun(place, Answer([text = std::move(answer)](const std::string&) { return text; })) {}
  ~FakeRun() { end(); }
  FakeRun(const FakeRun&) = delete;
  FakeRun& operator=(const FakeRun&) = delete;

  /// All requests in their order. Answers none from then on.
  const std::vector<std::string>& all_asked() {
    end();
    return asked_;
  }
  /// The last one; empty if there was none.
  std::string asked() { return all_asked().empty() ? "" : asked_.back(); }

 private:
  static std::optional<drivers::Descriptor> listen_anew(const std::filesystem::path& path) {
    std::filesystem::remove(path);
    return drivers::rt::listen_unix(path);
  }
  void end() {
    ended_ = true;
    if (thread_.joinable()) thread_.join();
  }
  void run(const Answer& answer) {
    drivers::rt::ReserveDescriptor reserve;
    while (!ended_) {
      pollfd at{.fd = listening_->get(), .events = POLLIN, .revents = 0};
      if (::poll(&at, 1, 10) != 1) continue;
      drivers::rt::serve_one(listening_->get(), reserve, "\n", {}, [&](const std::string& request) {
        asked_.push_back(request);
        return answer(request);
      });
    }
  }

  const FolderLock lock_;
  const std::optional<drivers::Descriptor> listening_;
  std::vector<std::string> asked_;
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

}  // namespace plumb::tests
