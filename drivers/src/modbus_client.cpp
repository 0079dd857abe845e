// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/modbus_client.hpp"

#include <algorithm>
#include <random>

#include "link_thread.hpp"
#include "modbus_faults.hpp"
#include "modbus_owner.hpp"
#include "modbus_reader.hpp"
#include "modbus_talk.hpp"
#include "modbus_writer.hpp"
#include "plumb/drivers/time_source.hpp"

namespace plumb::drivers {
namespace {

ModbusClientSettings with_token(ModbusClientSettings settings) {
  for (std::random_device random; settings.token == 0;) settings.token = random();
  return settings;
}

}  // namespace

class ModbusClient::Work {
 public:
  Work(const BusLayout& layout, const ModbusClientSettings& asked)
      : settings(with_token(asked)),
        codec_(layout),
        talk_(exchange.counters),
        reader_(layout, codec_, settings, talk_, exchange),
        owner_(layout, codec_, settings, talk_, exchange.counters),
        writer_(layout, codec_, settings, talk_, owner_, exchange) {}

  void run();

  ModbusClientSettings settings;
  ModbusExchange exchange;
  LinkThread thread;

 private:
  bool connect();
  void serve();
  bool round(std::int64_t now_ns);
  bool serial() const { return std::holds_alternative<SerialLine>(settings.server); }
  void back_off();

  ModbusCodec codec_;
  ModbusTalk talk_;
  ModbusReader reader_;
  ModbusOwner owner_;
  ModbusWriter writer_;
  double back_off_s_ = 0;
};

void ModbusClient::Work::run() {
  back_off_s_ = settings.first_back_off_s;
  while (!thread.stopping()) {
    if (connect()) serve();
    exchange.state = LinkState::kDown;
    if (!thread.stopping()) back_off();
  }
}

bool ModbusClient::Work::connect() {
  auto connection = ModbusConnection::open(settings, thread);
  if (!connection) return false;
  talk_.begin(std::move(connection), serial() ? ModbusTalk::Met::kNotYet : ModbusTalk::Met::kYes);
  reader_.begin();
  owner_.begin();
  return true;
}

void ModbusClient::Work::serve() {
  std::int64_t next_ns = MonotonicTime::now_ns();
  do {
    const std::int64_t now_ns = MonotonicTime::now_ns();
    if (!round(now_ns)) break;
    next_ns = std::max(next_ns + reader_.wake_ns(), now_ns);
  } while (thread.sleep_until_ns(next_ns));
  talk_.end();
}

/// Returns false if the connection can no longer be used.
bool ModbusClient::Work::round(std::int64_t now_ns) {
  talk_.begin_round();
  if (!reader_.round(now_ns) || !owner_.round(now_ns) || !writer_.round(now_ns)) return false;
  const bool refused = exchange.refusal.load(std::memory_order_relaxed).any();
  exchange.state = talk_.clean() && !refused ? LinkState::kUp : LinkState::kDegraded;
  back_off_s_ = settings.first_back_off_s;
  return true;
}

void ModbusClient::Work::back_off() {
  // On a serial line only waiting tells a late answer from the answer to the next request.
  const double wait_s = std::max(back_off_s_, serial() ? settings.response_timeout_s : 0.0);
  back_off_s_ = std::min(2 * back_off_s_, settings.longest_back_off_s);
  thread.sleep_until_ns(MonotonicTime::now_ns() + to_ns(wait_s));
}

ModbusClient::ModbusClient(const BusLayout& layout, const ModbusClientSettings& settings)
    : work_(std::make_unique<Work>(layout, settings)) {}

ModbusClient::~ModbusClient() { stop(); }

std::optional<LinkFault> ModbusClient::start() {
  if (auto fault = find_fault(work_->settings)) return fault;
  const int error = work_->thread.start("plumb-modbus", [work = work_.get()] { work->run(); });
  if (error == 0) return std::nullopt;
  return cannot_run(error);
}

void ModbusClient::stop() { work_->thread.stop(); }

ModbusExchange& ModbusClient::exchange() noexcept { return work_->exchange; }

}  // namespace plumb::drivers
