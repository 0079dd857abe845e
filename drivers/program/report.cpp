// SPDX-License-Identifier: Apache-2.0
#include "program/report.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "plumb/format/version.hpp"
#include "program/interrupt.hpp"
#include "program/printable.hpp"
#include "program/screen.hpp"

namespace plumb {
namespace {

constexpr std::size_t kShown = 20;  // problems of one kind
std::atomic<bool> hurried{false};

Json error_json(const Outcome& outcome) {
  if (outcome.errors.empty()) return nullptr;
  Json out = problem_json(outcome.errors.front());
  out.erase("severity");
  out["exit"] = static_cast<int>(outcome.exit);
  out["count"] = outcome.errors.size();
  Json all = Json::array();
  for (std::size_t i = 0; i < std::min(kShown, outcome.errors.size()); ++i)
    all.push_back(problem_json(outcome.errors[i]));
  out["problems"] = all;
  return out;
}

/// Unlike fmt::print it throws nothing if nobody can be told.
void tell(const std::string& line) { std::fputs((line + "\n").c_str(), stderr); }

void print_problems(const std::vector<Problem>& problems, const Screen& screen) {
  for (std::size_t i = 0; i < std::min(kShown, problems.size()); ++i)
    tell(painted(render(problems[i]), screen));
  if (problems.size() > kShown) tell(fmt::format("... and {} more", problems.size() - kShown));
}

/// False with errno set if not everything went out.
bool print_out(const std::string& text) {
  return std::fwrite(text.data(), 1, text.size(), stdout) == text.size() &&
         std::fflush(stdout) == 0;
}

int cannot_print(int reason) {
  tell(render({.code = "E-WRITE",
               .message = fmt::format("cannot write to stdout: {}", std::strerror(reason)),
               .help = "check what reads it: df -h"}));
  return static_cast<int>(Exit::kEnvironment);
}

/// The verdicts as they stand in the text.
std::vector<Verdict> verdicts_of(const Outcome& outcome) {
  std::vector<Verdict> out = outcome.verdicts;
  const Json& result = outcome.result;
  if (result.is_object() && result.contains("verdict_class"))
    out.push_back({result.value("verdict_text", result.value("verdict", "")),
                   result.value("verdict_class", "")});
  for (Verdict& verdict : out) verdict.sentence = printable_text(verdict.sentence);
  return out;
}

}  // namespace

std::string full_name(const Command& command) {
  return command.program + (command.verb.empty() ? "" : " ") + command.verb;
}

Json envelope(const Command& command, const Outcome& outcome) {
  const std::string& verb = command.verb.empty() ? command.program : command.verb;
  Json out{{"schema", command.program + "." + verb + "/1"},
           {"ok", outcome.exit == Exit::kDone},
           {"command", verb},
           {"version", format::kVersion},
           {"inputs", Json::array()},
           {"warnings", Json::array()},
           {"result", outcome.result},
           {"error", error_json(outcome)}};
  for (const auto& input : outcome.inputs)
    out["inputs"].push_back({{"file", input.file}, {"sha256", input.sha256}});
  for (const auto& remark : outcome.remarks) out["warnings"].push_back(problem_json(remark));
  return out;
}

int report(const Command& command, const Globals& globals, const Outcome& outcome) {
  if (hurried) end_within_a_second(outcome.exit);
  const bool json = globals.output == Globals::Output::kJson;
  const Screen messages = json ? Screen{} : screen_of(STDERR_FILENO);
  print_problems(outcome.remarks, messages);
  const bool printed = print_out(json ? to_text(envelope(command, outcome))
                                      : laid_out(printable_text(outcome.text),
                                                 screen_of(STDOUT_FILENO), verdicts_of(outcome)));
  const int reason = errno;
  print_problems(outcome.errors, messages);
  const int failed = printed ? 0 : cannot_print(reason);
  return printed || hurried ? static_cast<int>(outcome.exit) : failed;
}

void hurry_readers() { hurried = true; }

int print_verbatim(const std::string& text) {
  return print_out(text) ? static_cast<int>(Exit::kDone) : cannot_print(errno);
}

}  // namespace plumb
