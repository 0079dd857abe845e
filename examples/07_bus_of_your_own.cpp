// SPDX-License-Identifier: Apache-2.0
// A bus that is not in the library: messages over UDP. Whoever derives from BusPort has the whole
// session of plumb-rt on his bus: comparing, modes, ramps, faults, counters. Here a made-up
// controller moves the nominal arm and goes where it is told: 07_bus_of_your_own robot.plumb
#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <memory>
#include <thread>
#include <vector>

#include "examples/model_file.hpp"
#include "plumb/drivers/run_loop.hpp"

namespace {

using namespace plumb;
using namespace plumb::drivers;

/// One end of a UDP line on this machine. A datagram holds one BusMessage as it lies in memory,
/// which both ends agree on here; a real bus has a format of its own.
class UdpPort final : public BusPort {
 public:
  UdpPort() : socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
    here_.sin_family = AF_INET;
    here_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof here_;
    if (::bind(socket_, address(here_), size) == 0) ::getsockname(socket_, address(here_), &size);
  }
  ~UdpPort() override { ::close(socket_); }
  UdpPort(const UdpPort&) = delete;
  UdpPort& operator=(const UdpPort&) = delete;

  void connect(const UdpPort& other) {
    up_ = ::connect(socket_, address(other.here_), sizeof here_) == 0;
  }

  bool receive(BusMessage& message) noexcept override {
    if (::recv(socket_, &message, sizeof message, 0) != sizeof message) return false;
    message.time_ns = MonotonicTime::now_ns();
    ++counters_.received;
    return true;
  }
  bool send(const BusMessage& message) noexcept override {
    const bool sent = ::send(socket_, &message, sizeof message, MSG_NOSIGNAL) == sizeof message;
    ++(sent ? counters_.sent : counters_.not_sent);
    return sent;
  }
  LinkState state() const noexcept override { return up_ ? LinkState::kUp : LinkState::kDown; }
  PortCounters counters() const noexcept override { return counters_; }

 private:
  static sockaddr* address(const sockaddr_in& at) {
    return reinterpret_cast<sockaddr*>(const_cast<sockaddr_in*>(&at));
  }

  int socket_;
  sockaddr_in here_{};
  bool up_ = false;
  PortCounters counters_;
};

constexpr std::int64_t kCycle_ns = 4'000'000;
constexpr int kWanted = 100;  // corrected targets, then it ends

/// The robot controller: says where its arm is and is to be, and takes the answers.
void control(UdpPort& bus, const LoadedModel& model, std::atomic<int>& corrected,
             double& largest_m) {
  constexpr ControllerState kReady{
      .drives_on = true, .automatic = true, .protective_stop = false, .correction_enabled = true};
  std::vector<double> q;
  for (const auto& joint : model.model().nominal.joints)
    q.push_back(0.6 * joint.q_max + 0.4 * joint.q_min);
  const Chain& nominal = model.corrector().nominal();
  for (std::uint16_t counter = 0; corrected < kWanted; ++counter) {
    // Far enough that the poses compared are distinct, see [sync] in docs/run.md.
    for (double& x : q) x += counter % 1000 < 500 ? 5e-4 : -5e-4;
    const Transformd X_BD = nominal.forward(q);
    bus.send(controller_message(kReady, counter));
    bus.send(robot_message(fingerprint(model.model().serial), counter));
    bus.send(joints_message(MessageKind::kJoints, q, counter));
    bus.send(joints_message(MessageKind::kCommanded, q, counter));
    bus.send(pose_message(MessageKind::kActual, X_BD, counter));
    bus.send(pose_message(MessageKind::kTarget, X_BD, counter));
    for (BusMessage answer; bus.receive(answer);)
      if (const auto X_BC = pose_in(answer); answer.kind == MessageKind::kCorrected && X_BC) {
        largest_m = std::max(largest_m, (X_BC->p - X_BD.p).norm());
        ++corrected;
      }
    (void)MonotonicTime::sleep_until_ns(MonotonicTime::now_ns() + kCycle_ns);
  }
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr, "usage: 07_bus_of_your_own robot.plumb\n");
    return 2;
  }
  const auto model = load_or_exit(arguments[1]);
  UdpPort here, there;
  here.connect(there);
  there.connect(here);

  SessionSettings settings;
  settings.mode = CorrectionMode::kFull;
  settings.robot = fingerprint(model->model().serial);
  settings.cycle_s = 1e-9 * kCycle_ns;
  ModelSlot slot(*model);
  Session session(slot, settings);
  const auto shared = std::make_unique<RunShared>();
  CycleClock<MonotonicTime> clock(kCycle_ns);
  RunLoop<MonotonicTime> loop(session, here, *shared, clock, {}, {});

  std::atomic<int> corrected{0};
  double largest_m = 0.0;
  std::thread controller([&] { control(there, *model, corrected, largest_m); });
  auto next = loop.cycle();
  for (int cycle = 0; next == decltype(next){} && cycle < 5000; ++cycle) {
    if (corrected >= kWanted) shared->stop = true;  // ramps out, then ends
    next = loop.cycle();
  }
  corrected = kWanted;  // also if nothing came
  controller.join();
  std::printf("%s, %llu cycles, %llu messages heard, largest correction %.4f mm\n",
              next == RunLoop<MonotonicTime>::Next::kDone ? "ended by itself" : "given up",
              static_cast<unsigned long long>(session.report().counters.cycles),
              static_cast<unsigned long long>(here.counters().received), 1e3 * largest_m);
  return next == RunLoop<MonotonicTime>::Next::kDone ? 0 : 1;
}
