// SPDX-License-Identifier: Apache-2.0
#include "twin/fault.hpp"

#include <fmt/format.h>

#include <charconv>
#include <limits>
#include <optional>

#include "program/problem.hpp"

namespace plumb::offline::twin {
namespace {

enum class Size { kNone, kShare, kTime };

struct Entry {
  const char* name;
  FaultKind kind;
  Size size;
  const char* line;
};

constexpr Entry kEntries[] = {
    {"late", FaultKind::kLate, Size::kTime, "every frame comes later: late=20ms"},
    {"lose", FaultKind::kLose, Size::kShare, "frames never arrive: lose=30%"},
    {"repeat", FaultKind::kRepeat, Size::kShare, "frames arrive twice: repeat=10%"},
    {"corrupt", FaultKind::kCorrupt, Size::kShare, "frames have a flipped bit: corrupt=5%"},
    {"reorder", FaultKind::kReorder, Size::kShare, "frames arrive after later ones: reorder=10%"},
    {"disconnect", FaultKind::kDisconnect, Size::kNone, "no frame either way: disconnect@5+2"},
    {"reboot", FaultKind::kReboot, Size::kNone,
     "the controller is silent, then counts from zero: reboot@5+3"},
    {"freeze", FaultKind::kFreeze, Size::kNone, "the joint positions are old ones: freeze@5+1"},
    {"absolute", FaultKind::kAbsolute, Size::kNone,
     "the controller corrects its poses by itself already"},
    {"tool", FaultKind::kTool, Size::kNone, "another tool is active than the model's: tool@5"},
    {"no-context", FaultKind::kNoContext, Size::kNone,
     "payload, temperatures and time are not sent: no-context@5"},
    {"second-sender", FaultKind::kSecondSender, Size::kNone,
     "someone else sends corrections: second-sender@5+1"},
    {"stop", FaultKind::kStop, Size::kNone, "protective stop: stop@5+1"},
    {"manual", FaultKind::kManual, Size::kNone, "operating mode not automatic: manual@5+1"},
    {"drives-off", FaultKind::kDrivesOff, Size::kNone, "the drives are off: drives-off@5+1"},
    {"disable", FaultKind::kDisable, Size::kNone, "correction is not enabled: disable@5+1"},
    {"acknowledge", FaultKind::kAcknowledge, Size::kNone,
     "no fault: an operator acknowledges one: acknowledge@9+1"},
};

[[noreturn]] void refuse(const std::string& text, const std::string& why, const std::string& help) {
  throw Failure(
      Exit::kUsage,
      {.code = "E-TWIN-FAULT", .message = fmt::format("fault '{}': {}", text, why), .help = help});
}

const Entry& entry_of(const std::string& name, const std::string& text) {
  std::vector<std::string> names;
  for (const auto& entry : kEntries) {
    if (entry.name == name) return entry;
    names.emplace_back(entry.name);
  }
  const auto near = did_you_mean(name, names);
  refuse(text, "there is no such fault",
         near ? "did you mean '" + *near + "'?" : "plumb-twin run --list-faults");
}

/// A number and the unit that follows it.
struct Amount {
  double value = 0.0;
  std::string unit;
};

std::optional<Amount> amount(const std::string& text) {
  Amount out;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, out.value);
  if (error != std::errc() || !(out.value >= 0.0) || out.value > 1e6) return std::nullopt;
  out.unit.assign(rest, end);
  return out;
}

double seconds(const std::string& text, const std::string& whole) {
  const auto found = amount(text);
  if (found && (found->unit.empty() || found->unit == "s")) return found->value;
  if (found && found->unit == "ms") return found->value * 1e-3;
  refuse(whole, "'" + text + "' is no time",
         "for example: " + whole.substr(0, whole.find_first_of("=@")) + "@5+2");
}

double size_of(const Entry& entry, const std::optional<std::string>& text,
               const std::string& whole) {
  if (entry.size == Size::kNone) {
    if (text) refuse(whole, "it takes no size", fmt::format("--fault {}", entry.name));
    return 0.0;
  }
  if (!text) refuse(whole, "its size is missing", entry.line);
  if (entry.size == Size::kTime) return seconds(*text, whole);
  const auto share = amount(*text);
  if (!share || share->unit != "%" || share->value > 100.0)
    refuse(whole, "'" + *text + "' is no share", entry.line);
  return share->value * 0.01;
}

/// Cuts off `mark` and the text that follows it, and returns that text.
std::optional<std::string> cut(std::string& text, char mark) {
  const auto at = text.find(mark);
  if (at == std::string::npos) return std::nullopt;
  const std::string out = text.substr(at + 1);
  text.erase(at);
  return out;
}

}  // namespace

Fault parse_fault(const std::string& text) {
  std::string name = text;
  auto when = cut(name, '@');
  const auto size = cut(name, '=');
  const Entry& entry = entry_of(name, text);
  Fault out{.kind = entry.kind, .size = size_of(entry, size, text)};
  if (!when) return out;
  out.always = false;
  const auto length = cut(*when, '+');
  out.from_s = seconds(*when, text);
  out.for_s = length ? seconds(*length, text) : std::numeric_limits<double>::infinity();
  return out;
}

const std::vector<std::pair<std::string, std::string>>& known_faults() {
  static const auto all = [] {
    std::vector<std::pair<std::string, std::string>> out;
    for (const auto& entry : kEntries) out.emplace_back(entry.name, entry.line);
    return out;
  }();
  return all;
}

const Fault* FaultPlan::find(FaultKind kind, double path_s) const {
  for (const auto& fault : faults_) {
    if (fault.kind != kind) continue;
    if (fault.always) return &fault;
    if (path_s >= fault.from_s && path_s < fault.from_s + fault.for_s) return &fault;
  }
  return nullptr;
}

double FaultPlan::size(FaultKind kind, double path_s) const {
  const Fault* fault = find(kind, path_s);
  return fault == nullptr ? 0.0 : fault->size;
}

}  // namespace plumb::offline::twin
