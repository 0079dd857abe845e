// SPDX-License-Identifier: Apache-2.0
#include "rt/service.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "plumb/drivers/time_source.hpp"
#include "program/file.hpp"
#include "program/problem.hpp"
#include "rt/control_reply.hpp"
#include "rt/packing_text.hpp"
#include "rt/place.hpp"

namespace plumb::drivers::rt {
namespace {

constexpr int kPass_ms = 10;  // longest wait of one pass for a request
constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kDay_ns = 86'400 * kSecond_ns;

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

std::string shortage_text() {
  rlimit most{};
  ::getrlimit(RLIMIT_NOFILE, &most);
  return fmt::format(
      "no file descriptor is left (limit {}): files and connections cannot be opened, the "
      "correction "
      "goes on; see what keeps them with ls -l /proc/{}/fd, and raise LimitNOFILE of the service",
      most.rlim_cur, ::getpid());
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
      shared_(shared),
      control_(open_control(deployment.folder)),
      metrics_(open_metrics(deployment.config.metrics_port)),
      journal_(files == Files::kMade ? journal_file(deployment.folder, deployment.config.events)
                                     : std::filesystem::path{},
               files == Files::kMade ? Journal::Echo::kStderr : Journal::Echo::kNone),
      swap_(deployment, slot, facts_, journal_) {
  const RtConfig& config = deployment.config;
  facts_.bus = config.source->name();
  facts_.ceilings = config.ceilings;
  put_model(deployment, config.model, facts_);
  if (files == Files::kMade)
    make_files();
  else
    Recorder::check(recorder_files());
}

void Service::make_files() {
  const RtConfig& config = deployment_.config;
  if (config.source->has_robot()) {
    last_run_.emplace(deployment_.folder, deployment_.model.sha256);
    last_run_->begin();
    deployment_.session.start = last_run_->start();
    facts_.acknowledge = last_run_->why();
  }
  recorder_ = std::make_unique<Recorder>(recorder_files(), record_layout(deployment_), facts_.bus,
                                         shared_, deployment_.session.start);
  facts_.record = recorder_->facts();
}

Recorder::Files Service::recorder_files() const {
  const RtConfig& config = deployment_.config;
  const bool answers = config.sink.kind == SinkConfig::Kind::kCsv;
  return {.record = config.record,
          .snapshots = snapshot_folder(journal_.file()),
          .answers = answers ? config.sink.file : std::filesystem::path{}};
}

Service::~Service() {
  std::ignore = stop(Ended::kBadly);
  std::error_code ignored;
  std::filesystem::remove(control_.path, ignored);
}

/// The thread starts with all signals blocked, so that they reach the thread that ends the program.
void Service::start() {
  facts_.events = journal_.file().string();
  Json begun{{"bus", facts_.bus},
             {"mode", to_string(deployment_.session.mode)},
             {"file", facts_.model_file},
             {"sha256", facts_.model_sha256},
             {"fingerprint", deployment_.model.loaded->number()},
             {"acknowledge", facts_.acknowledge}};
  begun.update(event_details(facts_.origin));
  journal_.note("start", begun);
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, &before);
  recorder_->start();
  thread_ = std::thread([this] { run(); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

bool Service::stop(Ended ended) {
  ended_ = true;
  if (!thread_.joinable()) return true;
  const std::int64_t end_ns = MonotonicTime::now_ns() +
                              static_cast<std::int64_t>(kStop_s * static_cast<double>(kSecond_ns));
  while (!over_ && MonotonicTime::now_ns() < end_ns)
    std::ignore = MonotonicTime::sleep_until_ns(MonotonicTime::now_ns() + kSecond_ns / 1000);
  if (!over_) return false;
  thread_.join();
  if (last_run_ && ended == Ended::kWell) last_run_->end();
  return true;
}

void Service::run() {
  while (!ended_) pass();
  manager_.tell("STOPPING=1");
  recorder_->stop();
  write_down();
  remember();
  journal_.note("end", {{"state", to_string(snapshot_.session.state)},
                        {"cycles", snapshot_.session.counters.cycles}});
  over_ = true;
}

void Service::pass() {
  serve();
  if (swap_.go_on()) unsigned_ns_ = 0;
  write_down();
  remember();
  repeat_unsigned();
  bus_.tend();
  if (bus_.finished()) shared_.stop = true;
  tell_manager();
}

void Service::write_down() {
  shared_.snapshots.take(snapshot_);
  note_packing();
  for (SessionMoment moment; shared_.events.take(moment);) {
    journal_.note_change(moment);
    note_state(moment);
  }
  journal_.tend(MonotonicTime::now_ns());
  for (const RecordNotice& notice : recorder_->take_notices())
    journal_.note(notice.event, notice.details);
  facts_.events_failure = journal_.failure();
  facts_.events_lost = shared_.events.lost();
  facts_.record = recorder_->facts();
}

/// Keeps why the session is in its present state. In HOLD and FAULT that is the reason for which
/// it came there, which may be gone; elsewhere what it waits for now.
void Service::note_state(const SessionMoment& moment) {
  const bool latched = moment.state == SessionState::kHold || moment.state == SessionState::kFault;
  if (latched && moment.state == state_) return;
  state_ = moment.state;
  facts_.cause = cause_text(moment);
}

/// Notes a packing only once, although the link may lose it and find it again, and may find it for
/// other messages too.
void Service::note_packing() {
  facts_.packing = packing_text(snapshot_.packing, deployment_.layout);
  RegisterPacking now = snapshot_.packing;
  now.kind = packing_.kind;
  now.alone = packing_.alone;
  if (facts_.packing.empty() || now == packing_) return;
  packing_ = now;
  journal_.note("packing", {{"packing", facts_.packing}});
}

void Service::remember() {
  if (!last_run_) return;
  last_run_->note(snapshot_.session, facts_.model_sha256);
  const bool asks = has(snapshot_.session.lost, Lost::kAcknowledge) ||
                    snapshot_.session.state == SessionState::kFault;
  if (snapshot_.session.counters.cycles > 0 && !asks) facts_.acknowledge.clear();
}

/// Reads the version that the next start in this place would run.
void Service::look_at_place() {
  if (!facts_.origin.place.empty())
    facts_.origin.current = current_version_if_any(InstallPlace{deployment_.folder});
}

/// Repeats once a day, where signatures are demanded, that what runs has none: nobody shall forget
/// that it was waived.
void Service::repeat_unsigned() {
  const std::int64_t now_ns = MonotonicTime::now_ns();
  if (unsigned_ns_ != 0 && now_ns - unsigned_ns_ < kDay_ns) return;
  unsigned_ns_ = now_ns;
  if (!facts_.origin.note.empty() && deployment_.demands_signatures)
    journal_.note("unsigned", {{"note", facts_.origin.note}});
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
  reserve_.take();
  if (!reserve_.held())  // a connection that cannot be accepted waits on
    std::ignore = MonotonicTime::sleep_until_ns(MonotonicTime::now_ns() + kPass_ms * 1'000'000LL);
  pollfd at[] = {{.fd = control_.listening.get(), .events = POLLIN, .revents = 0},
                 {.fd = metrics_ ? metrics_->get() : -1, .events = POLLIN, .revents = 0}};
  if (::poll(at, 2, kPass_ms) <= 0) return;
  if (at[0].revents != 0) serve_control();
  if (at[1].revents != 0)
    serve_one(at[1].fd, reserve_, "\r\n\r\n", {},
              [this](const std::string& request) { return page(request); });
}

void Service::serve_control() {
  auto asked = take_request(control_.listening.get(), reserve_, "\n", {});
  if (!asked || (asked->uid != 0 && asked->uid != static_cast<std::int64_t>(::geteuid()))) return;
  shared_.snapshots.take(snapshot_);
  facts_.shortage = reserve_.held() ? "" : shortage_text();
  look_at_place();
  if (asked->request.starts_with("swap "))
    swap_.begin(std::move(*asked));
  else
    reply_to(asked->peer, control(asked->request), {});
  facts_.shortage.clear();
}

std::string Service::control(const std::string& request) const {
  if (request == "status") return reply({{"ok", true}, {"result", status_json(snapshot_, facts_)}});
  return refusal("E-RT-CONTROL", "not a request that this plumb-rt knows");
}

std::string Service::page(const std::string& request) {
  const std::string line = request.substr(0, request.find("\r\n"));
  if (!line.starts_with("GET /metrics ") && line != "GET /metrics")
    return http("404 Not Found", "text/plain", "GET /metrics\n");
  shared_.snapshots.take(snapshot_);
  look_at_place();
  return http("200 OK", "text/plain; version=0.0.4", metrics_text(snapshot_, facts_));
}

}  // namespace plumb::drivers::rt
