// SPDX-License-Identifier: Apache-2.0
#include "rt/service.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>

#include <cerrno>
#include <cstring>

#include "plumb/drivers/time_source.hpp"
#include "program/file.hpp"
#include "program/problem.hpp"
#include "rt/answer_file.hpp"
#include "rt/model_change.hpp"
#include "rt/screen_units.hpp"
#include "rt/swap_request.hpp"

namespace plumb::drivers::rt {
namespace {

constexpr int kPass_ms = 10;
constexpr std::int64_t kSwap_ns = 2'000'000'000, kSecond_ns = 1'000'000'000;

std::string reply(const Json& json) { return json.dump() + "\n"; }

std::string refusal(const char* code, const std::string& message) {
  return reply({{"ok", false}, {"error", {{"code", code}, {"message", message}}}});
}

std::optional<Descriptor> open_metrics(int port) {
  if (port == 0) return std::nullopt;
  auto out = listen_loopback(static_cast<std::uint16_t>(port));
  if (out) return out;
  throw Failure(
      Exit::kEnvironment,
      {.code = "E-RT-METRICS",
       .message = fmt::format("127.0.0.1:{} cannot be listened on: {}", port, std::strerror(errno)),
       .help = "choose another port in rt.toml, [log] metrics_port"});
}

std::string http(const char* line, const std::string& type, const std::string& body) {
  return fmt::format(
      "HTTP/1.0 {}\r\nContent-Type: {}\r\nContent-Length: {}\r\n"
      "Connection: close\r\n\r\n{}",
      line, type, body.size(), body);
}

}  // namespace

Service::Service(Deployment& deployment, OpenBus& bus, ModelSlot& slot, RunShared& shared,
                 Files files)
    : deployment_(deployment),
      bus_(bus),
      slot_(slot),
      shared_(shared),
      control_(open_control(deployment.folder)),
      metrics_(open_metrics(deployment.config.metrics_port)),
      journal_(files == Files::kMade ? journal_file(deployment.folder, deployment.config.events)
                                     : std::filesystem::path{},
               files == Files::kMade ? Journal::Echo::kStderr : Journal::Echo::kNone) {
  const RtConfig& config = deployment.config;
  facts_.bus = config.source->name();
  facts_.model_file = config.model.string();
  facts_.model_sha256 = deployment.model.sha256;
  facts_.ceilings = config.ceilings;
  facts_.model_limits = deployment.model.loaded->limits();
  if (files == Files::kMade)
    make_files();
  else
    check_files();
}

void Service::make_files() {
  const RtConfig& config = deployment_.config;
  if (!config.record.empty()) {
    record_ = std::make_unique<RecordWriter>(config.record, record_layout(deployment_), facts_.bus,
                                             config.record_max_mb);
    facts_.record = record_->file().string();
  }
  if (config.sink.kind == SinkConfig::Kind::kCsv)
    answers_ = std::make_unique<AnswerFile>(config.sink.file);
}

void Service::check_files() const {
  const RtConfig& config = deployment_.config;
  if (!config.record.empty()) RecordWriter::check(config.record);
  if (config.sink.kind == SinkConfig::Kind::kCsv) AnswerFile::check(config.sink.file);
}

Service::~Service() {
  stop();
  std::error_code ignored;
  std::filesystem::remove(control_.path, ignored);
}

/// The thread starts with all signals blocked, so that they reach the thread that ends the program.
void Service::start() {
  facts_.events = journal_.file().string();
  journal_.note("start", {{"bus", facts_.bus},
                          {"mode", to_string(deployment_.session.mode)},
                          {"file", facts_.model_file},
                          {"sha256", facts_.model_sha256},
                          {"fingerprint", deployment_.model.loaded->number()}});
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, &before);
  thread_ = std::thread([this] { run(); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

void Service::stop() {
  ended_ = true;
  if (thread_.joinable()) thread_.join();
}

void Service::run() {
  while (!ended_) pass();
  manager_.tell("STOPPING=1");
  write_down();
  journal_.note("end", {{"state", to_string(snapshot_.session.state)},
                        {"cycles", snapshot_.session.counters.cycles}});
}

void Service::pass() {
  serve();
  write_down();
  bus_.tend();
  if (bus_.finished()) shared_.stop = true;
  tell_manager();
}

void Service::write_down() {
  shared_.snapshots.take(snapshot_);
  for (SessionMoment moment; shared_.events.take(moment);) journal_.note_change(moment);
  facts_.events_failure = journal_.failure();
  facts_.events_lost = shared_.events.lost();
  for (RecordEntry entry; shared_.record.take(entry);) {
    if (record_) record_->add(entry);
    const bool answer =
        entry.what != RecordEntry::What::kReceived && entry.what != RecordEntry::What::kTick;
    if (answers_ && answer) answers_->add(entry.message);
  }
  facts_.record_lost = shared_.record.lost();
  if (!record_) return;
  record_->note_lost(facts_.record_lost);
  record_->flush();
  if (facts_.record_failure.empty() && !record_->failure().empty())
    journal_.note("record-ended", {{"reason", record_->failure()}});
  facts_.record_failure = record_->failure();
}

/// Sends the watchdog's keep-alive message only if the cycle has run since the last one.
void Service::tell_manager() {
  const std::uint64_t beats = shared_.beats;
  if (beats == told_beats_) return;
  if (!ready_) manager_.tell("READY=1");
  ready_ = true;
  const std::int64_t every_ns =
      manager_.watchdog_ns() > 0 ? std::min(manager_.watchdog_ns() / 2, kSecond_ns) : kSecond_ns;
  const std::int64_t now_ns = MonotonicTime::now_ns();
  if (now_ns - told_ns_ < every_ns) return;
  told_ns_ = now_ns;
  told_beats_ = beats;
  manager_.tell(fmt::format("WATCHDOG=1\nSTATUS={}, mode {}", to_string(snapshot_.session.state),
                            to_string(snapshot_.session.mode)));
}

void Service::serve() {
  pollfd at[] = {{.fd = control_.listening.get(), .events = POLLIN, .revents = 0},
                 {.fd = metrics_ ? metrics_->get() : -1, .events = POLLIN, .revents = 0}};
  if (::poll(at, 2, kPass_ms) <= 0) return;
  if (at[0].revents != 0)
    serve_one(at[0].fd, "\n", {}, [this](const std::string& request) { return control(request); });
  if (at[1].revents != 0)
    serve_one(at[1].fd, "\r\n\r\n", {},
              [this](const std::string& request) { return page(request); });
}

std::string Service::control(const std::string& request) {
  shared_.snapshots.take(snapshot_);
  if (request == "status") return reply({{"ok", true}, {"result", status_json(snapshot_, facts_)}});
  if (request.starts_with("swap ")) {
    const SwapRequest asked = read_swap(request.substr(5));
    std::string answer = swap(asked);
    note_swap(asked.file, answer);
    return answer;
  }
  return refusal("E-RT-CONTROL", "not a request that this plumb-rt knows");
}

/// Swaps in the model of a file. If it fails any check the running model stays in use.
std::string Service::swap(const SwapRequest& request) {
  const std::string& file = request.file;
  RunningModel next;
  try {
    next = load_model(file, deployment_.model.loaded->model().serial);
    refuse_wider(file, *next.loaded, deployment_.config.ceilings, deployment_.folder);
  } catch (const Failure& failure) {
    const Problem& first = failure.problems().front();
    return refusal(first.code.c_str(), first.message);
  } catch (const std::exception& error) {
    return refusal("E-RT-MODEL", error.what());
  }
  if (const auto short_of = find_short_reach(deployment_, *next.loaded); !short_of.empty())
    return refusal("E-RT-SWAP", short_of.front().what);
  if (!sensors_come(deployment_, *next.loaded))
    return refusal("E-RT-SWAP",
                   "it listens to a sensor that the model before does not: start plumb-rt anew");
  const LoadedModel& running = *deployment_.model.loaded;
  ModelChange change;
  if (find_binding_fault(running.model(), next.loaded->model()) == BindingFault::kNone) {
    change = find_change(running, *next.loaded);
    const Ceilings& ceilings = deployment_.config.ceilings;
    if (const auto fault = change_fault(change, request, ceilings); !fault.empty())
      return refusal("E-RT-CHANGE", fault);
  }
  const auto published = slot_.publish(*next.loaded);
  if (published == ModelSlot::Published::kBusy)
    return refusal("E-RT-SWAP", "the cycle has not taken the model before yet");
  if (published != ModelSlot::Published::kDone)
    return refusal("E-RT-SWAP",
                   to_string(find_binding_fault(running.model(), next.loaded->model())));
  std::swap(deployment_.model, next);
  const std::int64_t end_ns = MonotonicTime::now_ns() + kSwap_ns;
  while (!slot_.settled() && MonotonicTime::now_ns() < end_ns)
    std::ignore = MonotonicTime::sleep_until_ns(MonotonicTime::now_ns() + kSecond_ns / 1000);
  if (!slot_.settled()) next_ = std::move(next);  // kept, because the cycle may still use it
  facts_.model_file = file;
  facts_.model_sha256 = deployment_.model.sha256;
  facts_.model_limits = deployment_.model.loaded->limits();
  return reply({{"ok", true},
                {"result",
                 {{"file", file},
                  {"sha256", facts_.model_sha256},
                  {"change_mm", 1e3 * change.position_m},
                  {"change_deg", change.rotation_rad / kDegree},
                  {"fingerprint", deployment_.model.loaded->number()}}}});
}

/// Writes down what came of a request to swap.
void Service::note_swap(const std::string& file, const std::string& answer) {
  const Json said = Json::parse(answer, nullptr, false);
  Json details{{"file", file}};
  const bool done = said.is_object() && said.value("ok", false);
  const char* const part = done ? "result" : "error";
  if (said.is_object() && said.contains(part)) details.update(said[part]);
  journal_.note(done ? "swap" : "swap-refused", details);
}

std::string Service::page(const std::string& request) {
  const std::string line = request.substr(0, request.find("\r\n"));
  if (!line.starts_with("GET /metrics ") && line != "GET /metrics")
    return http("404 Not Found", "text/plain", "GET /metrics\n");
  shared_.snapshots.take(snapshot_);
  return http("200 OK", "text/plain; version=0.0.4", metrics_text(snapshot_, facts_));
}

}  // namespace plumb::drivers::rt
