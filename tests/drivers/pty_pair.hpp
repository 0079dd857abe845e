// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <poll.h>
#include <pty.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>

namespace plumb::tests {

/// A cable between two serial devices: what is written to one is read from the other.
class PtyPair {
 public:
  PtyPair() {
    for (End& end : ends_) open(end);
    relay_ = std::thread([this] { relay(); });
  }
  ~PtyPair() {
    over_ = true;
    relay_.join();
    for (End& end : ends_) {
      ::close(end.master);
      ::close(end.slave);
    }
  }
  PtyPair(const PtyPair&) = delete;
  PtyPair& operator=(const PtyPair&) = delete;

  const std::string& device(int i) const { return ends_.at(static_cast<std::size_t>(i)).device; }

  /// Cut: what is sent is lost.
  void cut() { cut_ = true; }
  void mend() { cut_ = false; }

 private:
  struct End {
    int master = -1;
    int slave = -1;  // kept open: else reading fails whenever a program closes its end
    std::string device;
  };

  static void open(End& end) {
    std::array<char, 64> name{};
    termios raw{};
    ::cfmakeraw(&raw);
    if (::openpty(&end.master, &end.slave, name.data(), &raw, nullptr) != 0)
      throw std::runtime_error("no pseudo-terminal");
    end.device = name.data();
  }

  void relay() {
    while (!over_) {
      std::array<pollfd, 2> events{pollfd{ends_[0].master, POLLIN, 0},
                                   pollfd{ends_[1].master, POLLIN, 0}};
      if (::poll(events.data(), events.size(), 10) <= 0) continue;
      for (std::size_t i = 0; i < 2; ++i)
        if ((events[i].revents & POLLIN) != 0) pass_on(ends_[i].master, ends_[1 - i].master);
    }
  }

  void pass_on(int from, int to) {
    std::array<char, 512> bytes{};
    const ssize_t got = ::read(from, bytes.data(), bytes.size());
    if (got > 0 && !cut_) [[maybe_unused]]
      const auto sent = ::write(to, bytes.data(), static_cast<std::size_t>(got));
  }

  std::array<End, 2> ends_;
  std::atomic<bool> over_{false};
  std::atomic<bool> cut_{false};
  std::thread relay_;
};

}  // namespace plumb::tests
