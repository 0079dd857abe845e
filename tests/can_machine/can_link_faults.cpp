// SPDX-License-Identifier: Apache-2.0
// What happens to an interface and to the processes around it. Run by tests/can_machine/can_faults.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>

#include <atomic>
#include <ctime>
#include <thread>

#include "plumb/drivers/can_interface.hpp"
#include "tests/can_machine/two_ports.hpp"

namespace plumb::tests {
namespace {

constexpr auto kFd = CanFrame::Format::kFd;
constexpr auto kClassic = CanFrame::Format::kClassic;

TEST(CanFault, InterfaceDownIsSeenCountedAndLeftBehind) {
  TwoPorts ports(kFd);
  ports.run(20);
  must("ip link set left down");
  EXPECT_FALSE(ports.send_status());
  ports.take_all();
  EXPECT_EQ(ports.plumb().state(), LinkState::kDown);
  ports.run(50);
  EXPECT_EQ(ports.heard(), 20);
  EXPECT_EQ(ports.plumb().link().errors().interface_downs, 1U);
  must("ip link set left up");
  const double ms = ports.recovery_ms();
  std::printf("interface up: heard again after %.1f ms\n", ms);
  EXPECT_GE(ms, 0.0);
  EXPECT_LT(ms, 500.0);
  EXPECT_EQ(ports.plumb().counters().reconnects, 1U);
}

TEST(CanFault, AnInterfaceThatOnlyListensComesBackWithTheNextFrame) {
  TwoPorts ports(kFd);
  must("ip link set left down");
  ports.take_all();
  EXPECT_EQ(ports.plumb().state(), LinkState::kDown);
  must("ip link set left up");
  wait_ms(5);
  ports.run(5);
  EXPECT_EQ(ports.plumb().state(), LinkState::kUp);
  EXPECT_EQ(ports.plumb().counters().reconnects, 1U);
}

TEST(CanFault, AnInterfaceThatWentAndCameBackIsTakenUpAgainBesideTheCycle) {
  TwoPorts ports(kFd);
  ports.run(20);
  must("ip link del left");
  ports.take_all();
  EXPECT_EQ(ports.plumb().state(), LinkState::kDown);
  EXPECT_FALSE(ports.plumb().recover());
  std::atomic<bool> bound{false};
  std::thread supervisor([&] {
    must("ip link add other0 type vcan");  // so that the index is another one
    must("ip link add left type vxcan peer name right");
    must("ip link set left mtu 72 up && ip link set right mtu 72 up");
    while (!ports.plumb().recover() || !ports.controller().recover()) wait_ms(10);
    bound = true;
  });
  while (!bound) {
    ports.send_status();
    ports.take_all();
    wait_ms(1);
  }
  supervisor.join();
  const double ms = ports.recovery_ms();
  std::printf("interface there again: heard again after %.1f ms\n", ms);
  EXPECT_GE(ms, 0.0);
  EXPECT_LT(ms, 500.0);
  must("ip link del other0");
}

TEST(CanFault, AFullTransmitQueueIsCountedAndNothingOldComesOutOfItLater) {
  TwoPorts ports(kFd);
  must("tc qdisc add dev left root tbf rate 200kbit burst 200 limit 400");
  int refused = 0;
  for (int i = 0; i < 300; ++i) refused += ports.send_status() ? 0 : 1;
  EXPECT_GT(refused, 200);
  EXPECT_EQ(ports.plumb().counters().not_sent, static_cast<unsigned>(refused));
  EXPECT_EQ(ports.plumb().state(), LinkState::kUp);
  must("tc qdisc del dev left root");
  EXPECT_TRUE(ports.send_status());
  std::printf("full queue: %d of 300 refused\n", refused);
}

TEST(CanFault, WhatOurQueueLostIsCountedAndWhatItKeptShowsItsAge) {
  TwoPorts ports(kFd);
  constexpr int kSent = 3000;
  for (int i = 0; i < kSent; ++i) ports.send_target();
  wait_ms(300);
  const std::int64_t before_ns = now_ns();
  BusMessage message;
  int taken = 0;
  while (ports.plumb().receive(message)) {
    EXPECT_LT(message.time_ns, before_ns - 250 * kMs);  // not one looks fresh
    ++taken;
  }
  ports.send_target();  // the kernel tells with the next frame
  EXPECT_EQ(ports.take_all(), 1);
  const auto counters = ports.plumb().counters();
  std::printf("%d sent to one who does not read: %d kept, %llu lost\n", kSent, taken,
              wide(counters.overflowed));
  EXPECT_GT(counters.overflowed, 0U);
  EXPECT_EQ(counters.overflowed + static_cast<unsigned>(taken), static_cast<unsigned>(kSent));
}

TEST(CanFault, ASecondSenderOfOurIdentifierIsCounted) {
  TwoPorts ports(kClassic);
  must("cansend right 130#0011223344556677");  // over the cable
  must("cansend left 132#0011223344556677");   // another program of this machine
  wait_ms(20);
  ports.take_all();
  EXPECT_EQ(ports.plumb().counters().foreign_senders, 2U);
  ports.send_status();  // our own do not come back
  wait_ms(5);
  ports.take_all();
  EXPECT_EQ(ports.plumb().counters().foreign_senders, 2U);
}

TEST(CanFault, FramesThatAreNoneOfOursAndRemoteFramesDoNotReachUs) {
  TwoPorts ports(kClassic);
  for (const char* frame : {"119#R", "7FF#00", "00000118#0011223344556677", "100#"})
    must(std::string("cansend right ") + frame);
  wait_ms(20);
  ports.take_all();
  const CanLinkCounters counters = ports.plumb().link().counters();
  EXPECT_EQ(counters.received + counters.remote + counters.malformed, 0U);
  must("cansend right 118#00");
  must("cansend right '118##0001122334455667700112233'");
  wait_ms(20);
  ports.take_all();
  EXPECT_EQ(ports.plumb().counters().corrupt, 1U);  // an FD frame does not reach a classic link
}

TEST(CanFault, SettingTheDateMakesNothingFresh) {
  for (const int hours : {-1, 1}) {
    TwoPorts ports(kFd);
    ports.date_was_set = true;
    ports.run(20);
    for (int i = 0; i < 5; ++i) ports.send_target();
    wait_ms(200);
    timespec date{};
    ASSERT_EQ(::clock_gettime(CLOCK_REALTIME, &date), 0);
    date.tv_sec += hours * 3600;
    ASSERT_EQ(::clock_settime(CLOCK_REALTIME, &date), 0);
    BusMessage message;
    for (int i = 0; i < 5; ++i) {
      ASSERT_TRUE(ports.plumb().receive(message));
      EXPECT_LT(message.time_ns, now_ns() - 190 * kMs);
    }
    EXPECT_EQ(ports.plumb().link().counters().clock_jumps, 1U);
    EXPECT_EQ(ports.take_all(), 0);
    ports.date_was_set = false;
    ports.run(20);
    EXPECT_EQ(ports.heard(), 40);
  }
}

/// A process that is stopped for a second.
void stop_for_a_second(pid_t process) {
  ::kill(process, SIGSTOP);
  wait_ms(1000);
  ::kill(process, SIGCONT);
}

TEST(CanFault, AfterASecondStoppedNothingOldLooksFresh) {
  TwoPorts ports(kFd);
  struct Seen {
    std::atomic<int> heard{0};
    std::atomic<std::int64_t> oldest_ns{0};  // age of what was heard
    std::atomic<int> false_fresh{0};
  };
  auto* const seen =
      new (::mmap(nullptr, sizeof(Seen), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0))
          Seen;
  const std::int64_t zero_ns = now_ns();
  const pid_t child = ::fork();
  if (child == 0) {
    for (BusMessage message;; wait_ms(1)) {
      while (ports.plumb().receive(message)) {
        // value 0 tells when it was sent [us since the beginning]
        const auto sent_ns = zero_ns + std::llround(message.values[0] * 1e9);
        ++seen->heard;
        if (message.time_ns > sent_ns + 50 * kMs) ++seen->false_fresh;
        seen->oldest_ns = std::max(seen->oldest_ns.load(), now_ns() - message.time_ns);
      }
    }
  }
  std::thread stopper([&] {
    wait_ms(300);
    stop_for_a_second(child);
  });
  constexpr int kSent = 400;
  for (int i = 0; i < kSent; ++i, wait_ms(4)) {
    BusMessage message{.kind = MessageKind::kTarget, .size = 6};
    message.counter = static_cast<std::uint16_t>(i);
    message.values.fill(0.0);
    message.values[0] = 1e-9 * static_cast<double>(now_ns() - zero_ns);
    ports.controller().send(message);
  }
  stopper.join();
  wait_ms(50);
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  std::printf("receiver stopped: %d of %d heard, the oldest %.0f ms old when heard\n",
              seen->heard.load(), kSent, 1e-6 * static_cast<double>(seen->oldest_ns));
  EXPECT_GT(seen->heard, kSent / 2);
  EXPECT_EQ(seen->false_fresh, 0);
  EXPECT_GT(seen->oldest_ns, 700 * kMs);
}

TEST(CanFault, ASenderThatStoppedIsSilentAndThenHeardAtOnce) {
  TwoPorts ports(kFd);
  const pid_t child = ::fork();
  if (child == 0)
    for (;; wait_ms(2)) ports.send_target();
  const std::int64_t end_ns = now_ns() + 2000 * kMs;
  std::thread stopper([&] {
    wait_ms(300);
    stop_for_a_second(child);
  });
  BusMessage message;
  std::int64_t last_ns = now_ns(), longest_ns = 0;
  int heard = 0;
  for (; now_ns() < end_ns; wait_ms(1)) {
    while (ports.plumb().receive(message)) {
      longest_ns = std::max(longest_ns, message.time_ns - last_ns);
      last_ns = message.time_ns;
      ++heard;
    }
  }
  stopper.join();
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  std::printf("sender stopped: silent for %.0f ms, %d heard\n",
              1e-6 * static_cast<double>(longest_ns), heard);
  EXPECT_GT(longest_ns, 950 * kMs);
  EXPECT_LT(longest_ns, 1200 * kMs);
}

TEST(CanOpen, RefusesWhatCannotCarryTheLayoutAndSaysWhatToDo) {
  may("ip link del bad0");
  must("ip link add bad0 type vcan");
  const auto refused = [](const char* name, CanFrame::Format format) {
    const auto opening = CanPort::open(name, layout_of(format), Sender::kPlumb);
    EXPECT_FALSE(opening.port);
    const Finding said = describe(opening.step);
    std::printf("%s; %s\n", said.why.c_str(), said.remedy.c_str());
    return opening.step.kind;
  };
  EXPECT_EQ(refused("none0", kClassic), CanStepKind::kInterface);
  EXPECT_EQ(refused("lo", kClassic), CanStepKind::kInterface);
  EXPECT_EQ(refused("bad0", kClassic), CanStepKind::kUp);
  must("ip link set bad0 mtu 16 up");
  EXPECT_EQ(refused("bad0", kFd), CanStepKind::kFormat);
  EXPECT_TRUE(CanPort::open("bad0", layout_of(kClassic), Sender::kPlumb).port);
  must("ip link del bad0");
}

TEST(CanInterfaces, AreReadFromTheKernel) {
  const auto can0 = read_can_interface("can0");  // --bitrate 500000
  ASSERT_TRUE(can0);
  EXPECT_EQ(can0->kind, "can");
  EXPECT_TRUE(can0->up);
  EXPECT_FALSE(can0->fd);
  EXPECT_EQ(can0->bit_rate, 500'000U);
  EXPECT_EQ(can0->restart_ms, 100U);
  const auto vcan0 = read_can_interface("vcan0");
  ASSERT_TRUE(vcan0);
  EXPECT_EQ(vcan0->kind, "vcan");
  EXPECT_TRUE(vcan0->fd);
  EXPECT_FALSE(vcan0->bit_rate);
  EXPECT_FALSE(read_can_interface("lo"));
  const auto found = misfits(layout_of(kClassic), *can0);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].why, "the bit rate is 500000 bit/s, the layout says 1000000 bit/s");
  const auto set_rate = [](const std::string& rate) {
    must("ip link set can0 down && ip link set can0 type can bitrate " + rate);
    must("ip link set can0 up");
  };
  set_rate("1000000");
  EXPECT_TRUE(misfits(layout_of(kClassic), *read_can_interface("can0")).empty());
  set_rate("500000");
}

}  // namespace
}  // namespace plumb::tests
