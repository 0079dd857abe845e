// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/modbus_client.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <vector>

#include "link_thread.hpp"
#include "modbus_connection.hpp"
#include "modbus_settings.hpp"
#include "modbus_spans.hpp"
#include "plumb/drivers/time_source.hpp"

namespace plumb::drivers {
namespace {

constexpr double kShortestPoll_s = 100e-6;
constexpr double kPollWithoutReads_s = 1e-3;

/// Registers between blocks cost less than another request over TCP, and more on a serial line.
int widest_gap(const ModbusClientSettings& settings) {
  return std::holds_alternative<TcpAddress>(settings.server) ? int{kMostRead} : 0;
}

/// The poses the other side moves by.
bool matters(MessageKind kind) {
  return kind == MessageKind::kCorrected || kind == MessageKind::kOffset ||
         kind == MessageKind::kTarget;
}

Sender other(Sender side) { return side == Sender::kPlumb ? Sender::kController : Sender::kPlumb; }

}  // namespace

class ModbusClient::Work {
 public:
  Work(const BusLayout& layout, const ModbusClientSettings& settings);

  void run();

  ModbusClientSettings settings;
  ModbusExchange exchange;
  LinkThread thread;

 private:
  using Result = ModbusConnection::Result;
  struct Poll {
    ModbusSpan span;
    std::int64_t period_ns = 0;
    std::int64_t due_ns = 0;
  };

  Poll poll_of(const ModbusSpan& span) const;
  bool connect();
  void serve();
  bool round(std::int64_t now_ns);
  void split_if_gaps_are_refused(std::size_t poll);
  Result read(const ModbusSpan& span);
  bool write_new(std::int64_t now_ns);
  bool take_fresh(const ModbusBlock& block, std::int64_t now_ns, BusMessage& message);
  bool write_run(std::int64_t now_ns);
  bool read_back();
  bool passed(Result result);
  bool serial() const { return std::holds_alternative<SerialLine>(settings.server); }
  void met();
  void back_off();

  ModbusCodec codec_;
  std::vector<Poll> polls_;
  std::vector<ModbusBlock> ours_;
  std::int64_t wake_ns_ = 0;  // period of the rounds
  std::unique_ptr<ModbusConnection> connection_;
  std::array<std::uint16_t, kMostRead> registers_{};

  std::array<std::uint16_t, kMostWrite> run_{};  // adjacent blocks to write in one request
  std::uint16_t run_first_ = 0;
  std::uint16_t run_count_ = 0;
  std::uint64_t run_messages_ = 0;
  bool run_matters_ = false;

  std::int64_t read_back_due_ns_ = 0;
  double back_off_s_ = 0;
  bool met_ = false;   // the server, on this connection
  bool clean_ = true;  // this round
};

ModbusClient::Work::Work(const BusLayout& layout, const ModbusClientSettings& asked)
    : settings(asked), codec_(layout), ours_(blocks_of(layout, codec_, asked.self)) {
  const auto spans =
      join(blocks_of(layout, codec_, other(asked.self)), kMostRead, widest_gap(asked));
  double wake_s = spans.empty() ? kPollWithoutReads_s : spans.front().period_s / 2;
  for (const auto& span : spans) wake_s = std::min(wake_s, span.period_s / 2);
  if (asked.poll_period_s > 0) wake_s = asked.poll_period_s;
  wake_ns_ = to_ns(std::max(wake_s, kShortestPoll_s));
  for (const auto& span : spans) polls_.push_back(poll_of(span));
}

ModbusClient::Work::Poll ModbusClient::Work::poll_of(const ModbusSpan& span) const {
  return {.span = span, .period_ns = std::max(wake_ns_, to_ns(span.period_s / 2)), .due_ns = 0};
}

void ModbusClient::Work::run() {
  back_off_s_ = settings.first_back_off_s;
  while (!thread.stopping()) {
    if (connect()) serve();
    exchange.state = LinkState::kDown;
    if (!thread.stopping()) back_off();
  }
}

bool ModbusClient::Work::connect() {
  connection_ = ModbusConnection::open(settings, thread);
  if (!connection_) return false;
  met_ = false;
  if (!serial()) met();  // a serial device opens whether or not anyone is at its other end
  read_back_due_ns_ = 0;
  for (Poll& poll : polls_) poll.due_ns = 0;
  return true;
}

void ModbusClient::Work::serve() {
  std::int64_t next_ns = MonotonicTime::now_ns();
  do {
    const std::int64_t now_ns = MonotonicTime::now_ns();
    if (!round(now_ns)) break;
    next_ns = std::max(next_ns + wake_ns_, now_ns);
  } while (thread.sleep_until_ns(next_ns));
  connection_.reset();
  ++exchange.counters.disconnects;
}

/// False: the connection is no good any more.
bool ModbusClient::Work::round(std::int64_t now_ns) {
  clean_ = true;
  for (std::size_t i = 0; i < polls_.size(); ++i) {
    Poll& poll = polls_[i];
    if (poll.due_ns > now_ns + wake_ns_ / 2) continue;  // the round nearest to it
    const Result result = read(poll.span);
    if (!passed(result)) return false;
    poll.due_ns += poll.period_ns;
    if (poll.due_ns <= now_ns) poll.due_ns = now_ns + poll.period_ns;
    if (result == Result::kRefused) split_if_gaps_are_refused(i);
  }
  if (!write_new(now_ns)) return false;
  exchange.state = clean_ ? LinkState::kUp : LinkState::kDegraded;
  back_off_s_ = settings.first_back_off_s;
  return true;
}

/// A server need not have the registers between blocks.
void ModbusClient::Work::split_if_gaps_are_refused(std::size_t poll) {
  const ModbusSpan span = polls_[poll].span;
  if (connection_->exception() != ModbusException::kIllegalAddress || span.blocks.size() < 2)
    return;
  polls_.erase(polls_.begin() + static_cast<std::ptrdiff_t>(poll));
  for (const auto& single : split(span)) polls_.push_back(poll_of(single));
}

ModbusClient::Work::Result ModbusClient::Work::read(const ModbusSpan& span) {
  const auto registers = std::span(registers_).first(span.count);
  const Result result = connection_->read(span.first, registers);
  if (result != Result::kDone) return result;
  const std::int64_t now_ns = MonotonicTime::now_ns();
  for (const auto& block : span.blocks) {
    BusMessage message;
    const auto words = registers.subspan(block.first - span.first, block.count);
    const Heard heard = codec_.decode(block.kind, words, message);
    if (heard == Heard::kComplete) {
      message.time_ns = now_ns;
      exchange.from_peer[static_cast<std::size_t>(block.kind)].put(message);
      ++exchange.counters.received;
    } else if (heard == Heard::kCorrupt) {
      ++exchange.counters.corrupt;
      clean_ = false;
    }
  }
  return result;
}

bool ModbusClient::Work::write_new(std::int64_t now_ns) {
  run_count_ = 0;
  for (const auto& block : ours_) {
    BusMessage message;
    if (!take_fresh(block, now_ns, message)) continue;
    const bool joins = run_first_ + run_count_ == block.first &&
                       run_count_ + block.count <= static_cast<int>(run_.size());
    if (!joins && !write_run(now_ns)) return false;
    if (run_count_ == 0) run_first_ = block.first;
    if (!codec_.encode(message, std::span(run_).subspan(run_count_, block.count))) continue;
    run_count_ = static_cast<std::uint16_t>(run_count_ + block.count);
    run_messages_ += 1;
    run_matters_ = run_matters_ || matters(block.kind);
  }
  return write_run(now_ns);
}

bool ModbusClient::Work::take_fresh(const ModbusBlock& block, std::int64_t now_ns,
                                    BusMessage& message) {
  if (!exchange.to_peer[static_cast<std::size_t>(block.kind)].take(message)) return false;
  if (now_ns - message.time_ns <= to_ns(settings.stale_after_s)) return true;
  ++exchange.counters.stale;
  return false;
}

bool ModbusClient::Work::write_run(std::int64_t now_ns) {
  if (run_count_ == 0) return true;
  const Result result = connection_->write(run_first_, std::span(run_).first(run_count_));
  if (result == Result::kDone)
    for (std::uint64_t i = 0; i < run_messages_; ++i) ++exchange.counters.sent;
  const bool due = result == Result::kDone && run_matters_ && now_ns >= read_back_due_ns_;
  const bool good = passed(result) && (!due || read_back());
  run_count_ = 0;
  run_messages_ = 0;
  run_matters_ = false;
  return good;
}

bool ModbusClient::Work::read_back() {
  const auto registers = std::span(registers_).first(run_count_);
  const Result result = connection_->read(run_first_, registers);
  if (result == Result::kDone) {
    if (std::ranges::equal(registers, std::span(run_).first(run_count_))) {
      read_back_due_ns_ = MonotonicTime::now_ns() + to_ns(settings.read_back_period_s);
    } else {
      ++exchange.counters.foreign_senders;
      clean_ = false;
    }
  }
  return passed(result);
}

/// Counts; false: the connection is no good any more.
bool ModbusClient::Work::passed(Result result) {
  ModbusCounters& counters = exchange.counters;
  switch (result) {
    case Result::kDone:
      ++counters.transactions;
      met();
      return true;
    case Result::kRefused:
      ++counters.refusals;
      met();
      clean_ = false;
      return true;
    case Result::kLate:
      ++counters.timeouts;
      return false;
    case Result::kBad:
      ++counters.bad_frames;
      return false;
    case Result::kLost:
      return false;
  }
  return false;
}

void ModbusClient::Work::met() {
  if (!met_) ++exchange.counters.connects;
  met_ = true;
}

void ModbusClient::Work::back_off() {
  // On a serial line nothing but time tells a late answer from the next one.
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
