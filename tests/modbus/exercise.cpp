// SPDX-License-Identifier: Apache-2.0
// Plumb's end of a Modbus link, for peers that are not ours:
//   modbus_exercise client|server ADDRESS SECONDS [SOUND_FROM]
// ADDRESS is HOST:PORT or a serial device. A cycle of 1 ms sends lawful messages and hears those of
// the peer. SOUND_FROM: CLOCK_MONOTONIC [s] from which on the peer is sound; the message after it
// must come soon. Prints one line of JSON; exit code 1: a wrong value came, the link did not come
// back, or its thread did not stop.
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "plumb/drivers/cycle_clock.hpp"
#include "plumb/drivers/modbus_client.hpp"
#include "plumb/drivers/modbus_port.hpp"
#include "plumb/drivers/modbus_server.hpp"
#include "tests/drivers/modbus_support.hpp"

using namespace plumb::drivers;
using plumb::tests::is_lawful;
using plumb::tests::lawful;

namespace {

constexpr double kLongestRecovery_s = 2.0;  // the back-off's 0.5 s, a time-out, and a slow machine
constexpr double kLongestStop_s = 1.0;

struct Verdict {
  std::uint64_t heard = 0;
  std::uint64_t wrong = 0;
  double longest_gap_s = 0;
  double recovery_s = -1;  // < 0: nothing came once the peer was sound
};

double now_s() { return static_cast<double>(MonotonicTime::now_ns()) * 1e-9; }

Verdict talk(ModbusExchange& exchange, const BusLayout& layout, double seconds, double sound_from) {
  ModbusPort port(exchange, layout, Sender::kPlumb);
  Verdict out;
  std::uint16_t counter = 0;
  const double end = now_s() + seconds;
  double last = now_s();
  for (CycleClock<> clock(1'000'000); now_s() < end; clock.wait()) {
    ++counter;
    for (const auto& message : layout.messages)
      if (message.sender == Sender::kPlumb) port.send(lawful(layout, message.kind, counter));
    BusMessage heard;
    while (port.receive(heard)) {
      const double now = now_s();
      ++out.heard;
      if (!is_lawful(layout, heard)) ++out.wrong;
      out.longest_gap_s = std::max(out.longest_gap_s, now - last);
      last = now;
      if (now > sound_from && out.recovery_s < 0) out.recovery_s = now - sound_from;
    }
  }
  out.longest_gap_s = std::max(out.longest_gap_s, now_s() - last);
  return out;
}

ModbusAddress address_in(const std::string& text) {
  const auto colon = text.rfind(':');
  if (text.front() == '/') return SerialLine{.device = text, .parity = SerialLine::Parity::kNone};
  return TcpAddress{text.substr(0, colon),
                    static_cast<std::uint16_t>(std::atoi(text.c_str() + colon + 1))};
}

template <class Link, class Settings>
int run(const Settings& settings, double seconds, double sound_from) {
  const bool serial = std::holds_alternative<SerialLine>(settings.first);
  const BusLayout layout = default_layout(6, serial ? 0.02 : 0.001);
  Link link(layout, settings.second);
  if (const auto fault = link.start()) {
    std::fprintf(stderr, "%s: %s\n", fault->key.c_str(), fault->what.c_str());
    return 5;
  }
  const Verdict verdict = talk(link.exchange(), layout, seconds, sound_from);
  const double before = now_s();
  link.stop();
  const double stop_s = now_s() - before;
  const ModbusCounters& c = link.exchange().counters;
  const auto n = [](const Count& count) { return static_cast<unsigned long long>(count); };
  std::printf(
      "{\"heard\": %llu, \"wrong\": %llu, \"longest_gap_ms\": %.0f, \"recovery_ms\": %.0f, "
      "\"stop_ms\": %.1f, \"requests_per_s\": %.0f, \"sent\": %llu, \"corrupt\": %llu, "
      "\"refusals\": %llu, \"timeouts\": %llu, \"bad_frames\": %llu, \"connects\": %llu, "
      "\"foreign_senders\": %llu, \"stale\": %llu}\n",
      static_cast<unsigned long long>(verdict.heard),
      static_cast<unsigned long long>(verdict.wrong), 1e3 * verdict.longest_gap_s,
      1e3 * verdict.recovery_s, 1e3 * stop_s, static_cast<double>(n(c.transactions)) / seconds,
      n(c.sent), n(c.corrupt), n(c.refusals), n(c.timeouts), n(c.bad_frames), n(c.connects),
      n(c.foreign_senders), n(c.stale));
  const bool back = verdict.recovery_s >= 0 && verdict.recovery_s <= kLongestRecovery_s;
  return verdict.wrong == 0 && back && stop_s <= kLongestStop_s ? 0 : 1;
}

}  // namespace

int main(int count, char** words) {
  if (count < 4) return std::fprintf(stderr, "see the top of its source\n"), 2;
  const ModbusAddress address = address_in(words[2]);
  const double seconds = std::atof(words[3]);
  const double sound_from = count > 4 ? std::atof(words[4]) : now_s();
  if (std::strcmp(words[1], "server") == 0)
    return run<ModbusServer>(
        std::pair{address, ModbusServerSettings{.at = address, .peers = {"127.0.0.1"}}}, seconds,
        sound_from);
  return run<ModbusClient>(std::pair{address, ModbusClientSettings{.server = address}}, seconds,
                           sound_from);
}
