// SPDX-License-Identifier: Apache-2.0
#include "rt/outcome.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "plumb/format/version.hpp"

namespace plumb::drivers::rt {
namespace {

/// The same shape as the errors of `plumb --json`.
Json error_json(const Outcome& outcome) {
  if (!outcome.error) return nullptr;
  const Json problem{{"severity", "error"},
                     {"code", outcome.error->code},
                     {"message", outcome.error->message},
                     {"place", nullptr},
                     {"help", outcome.error->help}};
  Json out = problem;
  out.erase("severity");
  out["exit"] = static_cast<int>(outcome.exit);
  out["count"] = 1;
  out["problems"] = Json::array({problem});
  return out;
}

void print_error(const Error& error) {
  fmt::print(stderr, "error[{}]: {}\n", error.code, error.message);
  if (!error.help.empty()) fmt::print(stderr, "   = help: {}\n", error.help);
}

bool print_out(const std::string& text) {
  return std::fwrite(text.data(), 1, text.size(), stdout) == text.size() &&
         std::fflush(stdout) == 0;
}

}  // namespace

Json envelope(const std::string& verb, const Outcome& outcome) {
  return {{"schema", "plumb-rt." + verb + "/1"},
          {"ok", outcome.exit == Exit::kClean},
          {"command", verb},
          {"version", format::kVersion},
          {"inputs", Json::array()},
          {"warnings", Json::array()},
          {"result", outcome.result},
          {"error", error_json(outcome)}};
}

int report(const std::string& verb, const Globals& globals, const Outcome& outcome) {
  const bool json = globals.output == Globals::Output::kJson;
  const auto replace = Json::error_handler_t::replace;
  const bool printed =
      print_out(json ? envelope(verb, outcome).dump(2, ' ', false, replace) + "\n" : outcome.text);
  const int reason = errno;
  if (outcome.error) print_error(*outcome.error);
  if (printed) return static_cast<int>(outcome.exit);
  print_error({.code = "E-WRITE",
               .message = fmt::format("cannot write to stdout: {}", std::strerror(reason)),
               .help = "check what reads it: df -h"});
  return static_cast<int>(Exit::kEnvironment);
}

}  // namespace plumb::drivers::rt
