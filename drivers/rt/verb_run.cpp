// SPDX-License-Identifier: Apache-2.0
#include "rt/verb_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <filesystem>
#include <memory>
#include <tuple>

#include "plumb/drivers/rt_process.hpp"
#include "plumb/drivers/run_loop.hpp"
#include "program/file.hpp"
#include "program/folder_lock.hpp"
#include "program/report.hpp"
#include "program/shell_word.hpp"
#include "rt/journal.hpp"
#include "rt/rt_probe.hpp"
#include "rt/service.hpp"
#include "rt/standard_error.hpp"
#include "rt/stop_signal.hpp"

namespace plumb::drivers::rt {
namespace {

struct RunOptions {
  std::string dir;
  int priority = -1;
  bool check = false;
  std::string etc = kEtc;
};

RtRequest request_of(const RtConfig& config, const int& cpu) {
  RtRequest out{.priority = config.priority};
  if (cpu >= 0) out.processors = {&cpu, 1};
  if (config.priority == 0) {
    out.lock = RtRequest::Lock::kNone;
    out.idle_latency_us = -1;
  }
  return out;
}

/// Tries in a child process what a real-time cycle cannot do without, so that a refusal comes
/// before anything is opened.
void need_rights(const RtConfig& config, Outcome& outcome) {
  const auto steps = try_rt_process(request_of(config, config.cpu));
  if (steps.empty())
    throw Failure(Exit::kEnvironment,
                  {.code = "E-RT-RIGHTS",
                   .message = "what the machine grants could not be tried: no child process",
                   .help = "ulimit -u; systemctl show plumb-rt@NAME -p SystemCallFilter"});
  for (const RtStep& step : steps) {
    if (step.grant != Grant::kDenied) continue;
    const Finding finding = describe(step);
    const bool needed = step.kind == RtStepKind::kPriority || step.kind == RtStepKind::kAffinity;
    Problem problem{.severity = needed ? Severity::kError : Severity::kWarning,
                    .code = needed ? "E-RT-RIGHTS" : "W-RT-RIGHTS",
                    .message = fmt::format("{}: {}", finding.what, finding.why),
                    .help = finding.remedy};
    if (needed) throw Failure(Exit::kEnvironment, problem);
    outcome.remarks.push_back(problem);
  }
}

void note_sensors(const Deployment& deployment, Outcome& outcome) {
  const auto missing = sensors_missing(deployment.layout, deployment.model.loaded->model());
  if (missing.empty()) return;
  outcome.remarks.push_back(
      {.severity = Severity::kWarning,
       .code = "W-RT-SENSORS",
       .message = fmt::format("the model listens to {}, which the bus does not bring: it will use "
                              "its fallback",
                              fmt::join(missing, ", ")),
       .help = "plumb deploy, with [deploy.bus] temperatures = [...] in cell.toml"});
}

/// Says of a folder that no trusted key signed why it runs all the same, where that is an
/// exception.
void note_origin(const Deployment& deployment, const SigningRules& rules, Outcome& outcome) {
  outcome.remark(key_warnings(rules));
  if (!rules.demanded() || deployment.model.origin.note.empty()) return;
  outcome.remarks.push_back({.severity = Severity::kWarning,
                             .code = "W-RT-UNSIGNED",
                             .message = fmt::format("{} is {}", display_name(deployment.folder),
                                                    deployment.model.origin.note),
                             .help = "plumb deploy --sign FILE.key"});
}

/// Prints the remarks at once, because the end of the run may be a year away.
void say(const std::vector<Problem>& remarks) {
  for (const Problem& remark : remarks) std::ignore = say_at_once(render(remark) + "\n");
}

using Loop = RunLoop<MonotonicTime>;

Loop::Next go(Loop& loop) {
  Loop::Next next = Loop::Next::kGoOn;
  while (next == Loop::Next::kGoOn) next = loop.cycle();
  loop.publish(MonotonicTime::now_ns());
  return next;
}

void refuse_end(Loop::Next next, const Deployment& deployment, Outcome& outcome) {
  if (next == Loop::Next::kBusLost) {
    outcome.exit = Exit::kBusLost;
    outcome.errors = {
        {.code = "E-RT-LOST",
         .message = fmt::format("{} was down for {} s", deployment.config.source->name(),
                                deployment.config.give_up_s),
         .help = "plumb-rt doctor"}};
  } else if (next == Loop::Next::kClockFailed) {
    outcome.exit = Exit::kEnvironment;
    outcome.errors = {
        {.code = "E-RT-CLOCK", .message = "the clock cannot sleep", .help = "plumb-rt doctor"}};
  }
}

Loop::Next cycle_until_told(Deployment& deployment, OpenBus& bus, ModelSlot& slot,
                            RunShared& shared) {
  auto session = std::make_unique<Session>(slot, deployment.session);
  const RtConfig& config = deployment.config;
  const bool to_port = config.sink.kind == SinkConfig::Kind::kSame;
  const RunSettings settings{
      .give_up_ns = static_cast<std::int64_t>(1e9 * config.give_up_s),
      .answers = to_port ? RunSettings::Answers::kToPort : RunSettings::Answers::kRecordOnly};
  auto clock = std::make_unique<CycleClock<MonotonicTime>>(1000LL * config.cycle_us);
  auto loop =
      std::make_unique<Loop>(*session, bus.port(), shared, *clock, MonotonicTime{}, settings);
  const RtProcess process(request_of(config, config.cpu));
  return go(*loop);
}

void ask_operator(const Service& service, const Deployment& deployment) {
  if (service.acknowledgement().empty() || deployment.session.mode == CorrectionMode::kShadow)
    return;
  say({{.severity = Severity::kWarning,
        .code = "W-RT-ACKNOWLEDGE",
        .message = fmt::format("an operator must acknowledge before the first correction: {}",
                               service.acknowledgement()),
        .help = "hold the controller's button for 0.2 s and release it, when this says state "
                "shadow: plumb-rt status " +
                shell_word(display_name(deployment.folder))}});
}

/// A thread that waits for a disk for ever cannot be ended, but the program can.
[[noreturn]] void end_without_service() {
  const Problem problem{.severity = Severity::kError,
                        .code = "E-RT-STOP",
                        .message = "a file that is written to does not answer",
                        .help = "check the disk of [log] in rt.toml"};
  std::ignore = say_at_once(render(problem) + "\n");
  ::_exit(static_cast<int>(Exit::kEnvironment));
}

/// The deploy folder, held for as long as the process lives: no second plumb-rt runs it.
FolderLock held_alone(const std::filesystem::path& folder) {
  FolderLock lock(folder);
  // An install looks for a moment whether somebody holds it.
  if (lock.wait(std::chrono::milliseconds(300)) == FolderLock::State::kBusy)
    throw Failure(Exit::kEnvironment,
                  {.code = "E-RT-RUNNING",
                   .message = fmt::format("another plumb-rt runs {}, or is stopped in it",
                                          display_name(folder)),
                   .help = "plumb-rt status " + shell_word(display_name(folder))});
  if (lock.state() == FolderLock::State::kImpossible)
    throw Failure(Exit::kEnvironment,
                  {.code = "E-RT-LOCK",
                   .message = fmt::format("{} cannot be locked: {}", display_name(folder),
                                          std::strerror(lock.error())),
                   .help = "keep the folder on a local file system, readable by plumb-rt"});
  return lock;
}

/// Stops the service even if the cycle throws while it is set up.
void run_folder(const RunOptions& options, Outcome& outcome) {
  const SigningRules rules = read_signing_rules(options.etc);
  Deployment deployment = load_deployment(options.dir, Sums::kVerified, &rules);
  const FolderLock alone = held_alone(options.dir);
  // So that no install removes the version that runs; of a deploy folder there is only the one
  // lock.
  const FolderLock version(deployment.model.version.empty() ? std::filesystem::path{}
                                                            : deployment.content);
  note_origin(deployment, rules, outcome);
  if (options.priority >= 0) deployment.config.priority = options.priority;
  outcome.inputs.push_back({deployment.config.model.string(), deployment.model.sha256});
  need_rights(deployment.config, outcome);
  note_sensors(deployment, outcome);
  static RunShared shared;  // the signal's handler keeps its address
  const BusLayout recorded = record_layout(deployment);
  const auto bus = deployment.config.source->open(
      {deployment.layout, recorded, *deployment.model.loaded, deployment.session});
  ModelSlot slot(*deployment.model.loaded);
  Service service(deployment, *bus, slot, shared,
                  options.check ? Service::Files::kChecked : Service::Files::kMade);
  if (options.check) {
    outcome.text = fmt::format("{}: sound, nothing was sent or written\n", options.dir);
    outcome.result = {{"checked", true}};
    return;
  }
  stop_on_signal(shared.stop);
  say(outcome.remarks);
  service.start();
  std::ignore =
      say_at_once(fmt::format("plumb-rt: {} on {}, cycle {} us, mode {}\n",
                              deployment.config.model.string(), deployment.config.source->name(),
                              deployment.config.cycle_us, to_string(deployment.session.mode)));
  ask_operator(service, deployment);
  const Loop::Next next = cycle_until_told(deployment, *bus, slot, shared);
  const bool well = next == Loop::Next::kDone || next == Loop::Next::kBusLost;
  if (!service.stop(well ? Service::Ended::kWell : Service::Ended::kBadly)) end_without_service();
  outcome.result = status_json(service.snapshot(), service.facts());
  outcome.text = status_text(outcome.result);
  refuse_end(next, deployment, outcome);
}

/// A run that is refused leaves its reason in the journal of the folder.
void run(const RunOptions& options, Outcome& outcome) {
  if (!options.check) hurry_readers();
  try {
    run_folder(options, outcome);
  } catch (const Failure& failure) {
    std::error_code ignored;
    if (!options.check && std::filesystem::is_directory(options.dir, ignored)) {
      const Problem& first = failure.problems().front();
      Journal(journal_file(options.dir, {}), Journal::Echo::kNone)
          .note("not-started", {{"code", first.code}, {"message", first.message}});
    }
    throw;
  }
}

}  // namespace

void add_run(Program& program) {
  const auto options = std::make_shared<RunOptions>();
  VerbOptions verb = program.verb(
      {.name = "run",
       .summary = "The real-time cycle with the model and the bus of a folder, until SIGTERM",
       .examples = "  plumb-rt run /var/lib/plumb/cell4              # as rt.toml says\n"
                   "  plumb-rt run deployed --check              # is all of it usable? sends "
                   "nothing"},
      [options](const Globals&, Outcome& outcome) { run(*options, outcome); });
  verb.add_option("DIR", options->dir, "The folder that 'plumb deploy' wrote, or a place")
      .required();
  verb.add_option("--priority", options->priority,
                  "SCHED_FIFO priority instead of that in rt.toml; 0: an ordinary thread")
      .check(whole_number_between(0, 99));
  verb.add_flag("--check", options->check, "Open everything, send and write nothing, end");
  add_etc_option(verb, options->etc);
}

}  // namespace plumb::drivers::rt
