// SPDX-License-Identifier: Apache-2.0
// Our end of a CAN bus, for tests/can_machine/can_peers: what others write we read, and the other
// way round. The values follow a rule that can_peer.py states for itself.
//   can_end tell INTERFACE classic|fd COUNT         the messages of plumb-rt, with counters 0, 1,
//   ... can_end hear INTERFACE classic|fd COUNT         prints messages of the controller, in
//   counts can_end frames INTERFACE classic|fd ID COUNT    prints frames as candump -L does can_end
//   count INTERFACE ID COUNT                sends a byte that counts, as cansequence does can_end
//   pong INTERFACE COUNT                    the other side of canfdtest
// The last but one receive until COUNT came or 20 s passed without any, and say when they are
// ready.
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "plumb/drivers/can_port.hpp"
#include "plumb/drivers/time_source.hpp"

namespace {

using namespace plumb::drivers;

constexpr std::int64_t kPatience_ns = 20'000'000'000;

struct Options {
  std::string interface;
  BusLayout layout;
  std::uint32_t id = 0;
  long count = 0;
};

template <class T>
bool denied(const T& opening) {
  if (opening.step.grant == Grant::kGranted) return false;
  const Finding said = describe(opening.step);
  std::fprintf(stderr, "error: %s\nhelp: %s\n", said.why.c_str(), said.remedy.c_str());
  return true;
}

/// Value i of message k, in counts: the ends of a range, zero and no number first.
double counts(std::int64_t k, std::size_t i) {
  constexpr double kFirst[] = {8388607.0, -8388607.0, NAN, 0.0, 1.0, -1.0, 2.0};
  if (k == 0) return kFirst[i];
  return static_cast<double>((k * 1'000'003 + static_cast<std::int64_t>(i) * 7919) % 8'000'001 -
                             4'000'000);
}

int tell(const Options& options) {
  auto opening = CanPort::open(options.interface, options.layout, Sender::kPlumb);
  if (denied(opening)) return 5;
  for (long k = 0; k < options.count; ++k) {
    for (const auto& entry : options.layout.messages) {
      if (entry.sender != Sender::kPlumb) continue;
      BusMessage message{.kind = entry.kind,
                         .size = static_cast<std::uint8_t>(entry.signals.size()),
                         .counter = static_cast<std::uint16_t>(k)};
      for (std::size_t i = 0; i < message.size; ++i)
        message.values[i] = counts(k, i) * entry.signals[i].scale;
      while (!opening.port->send(message)) ::usleep(1000);
    }
    ::usleep(5000);
  }
  return 0;
}

/// Calls `take` until it took `count`; false if none came for long.
template <class F>
bool until(long count, F take) {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // whoever kills us has what was heard
  std::puts("ready");
  std::int64_t last_ns = MonotonicTime::now_ns();
  while (count > 0 && MonotonicTime::now_ns() - last_ns < kPatience_ns) {
    if (!take()) {
      ::usleep(500);
      continue;
    }
    last_ns = MonotonicTime::now_ns();
    --count;
  }
  return count == 0;
}

void print(const BusLayout& layout, const BusMessage& message) {
  const MessageLayout& entry = *layout.find(message.kind);
  std::printf("%s %d", entry.name.c_str(), message.counter);
  for (std::size_t i = 0; i < message.size; ++i) {
    const double value = message.values[i] / entry.signals[i].scale;
    if (std::isnan(value))
      std::printf(" nan");
    else
      std::printf(" %ld", std::lround(value));
  }
  std::puts("");
}

int hear(const Options& options) {
  auto opening = CanPort::open(options.interface, options.layout, Sender::kPlumb);
  if (denied(opening)) return 5;
  BusMessage message;
  const bool all = until(options.count, [&] {
    if (!opening.port->receive(message)) return false;
    print(options.layout, message);
    return true;
  });
  const PortCounters c = opening.port->counters();
  if (c.corrupt + c.foreign_senders + c.overflowed != 0) return 1;
  return all ? 0 : 1;
}

void print(const CanFrame& frame) {
  const char* const id = frame.id_kind == CanFrame::Id::kExtended ? "%08X#" : "%03X#";
  std::printf(id, frame.id);
  if (frame.format == CanFrame::Format::kFd) std::printf("#");
  for (std::size_t i = 0; i < frame.length; ++i) std::printf("%02X", frame.data[i]);
  std::puts("");
}

CanOpening open_link(const Options& options) {
  const CanFilter filters[] = {{.id = options.id},
                               {.id = options.id, .id_kind = CanFrame::Id::kExtended}};
  return CanLink::open(options.interface, filters, can_link_options(options.layout));
}

int frames(const Options& options) {
  auto opening = open_link(options);
  if (denied(opening)) return 5;
  CanFrame frame;
  const bool all = until(options.count, [&] {
    if (!opening.link->receive(frame)) return false;
    print(frame);
    return true;
  });
  return all && opening.link->counters().overflowed == 0 ? 0 : 1;
}

int count(const Options& options) {
  auto opening = open_link(options);
  if (denied(opening)) return 5;
  for (long k = 0; k < options.count; ++k) {
    const CanFrame frame{.id = options.id, .length = 1, .data = {static_cast<std::uint8_t>(k)}};
    while (!opening.link->send(frame)) ::usleep(1000);
    ::usleep(500);
  }
  return 0;
}

/// canfdtest sends 0x77, and wants each byte plus one back as 0x78.
int pong(const Options& options) {
  auto opening = open_link(options);
  if (denied(opening)) return 5;
  CanFrame frame;
  const bool all = until(options.count, [&] {
    if (!opening.link->receive(frame)) return false;
    ++frame.id;
    for (std::size_t i = 0; i < frame.length; ++i) ++frame.data[i];
    return opening.link->send(frame);
  });
  return all ? 0 : 1;
}

int run(const std::string& verb, Options& options, char** argv) {
  const bool fd = std::string(argv[0]) == "fd";
  options.layout = default_layout(6, 0.004);
  options.layout.can_format = fd ? CanFrame::Format::kFd : CanFrame::Format::kClassic;
  if (verb == "pong") {
    options.id = 0x77;
    options.count = std::atol(argv[0]);
    return pong(options);
  }
  if (verb == "count" || verb == "frames") {
    const int shift = verb == "frames" ? 1 : 0;
    options.id = static_cast<std::uint32_t>(std::strtoul(argv[shift], nullptr, 16));
    options.count = std::atol(argv[shift + 1]);
    return shift == 1 ? frames(options) : count(options);
  }
  options.count = std::atol(argv[1]);
  return verb == "tell" ? tell(options) : hear(options);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string verb = argc > 1 ? argv[1] : "";
  const int most = verb == "frames" ? 6 : verb == "pong" ? 4 : 5;
  if (argc != most) {
    std::fprintf(stderr, "usage: can_end tell|hear|frames|count|pong INTERFACE ...\n");
    return 2;
  }
  Options options;
  options.interface = argv[2];
  return run(verb, options, argv + 3);
}
