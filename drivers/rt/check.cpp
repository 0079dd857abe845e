// SPDX-License-Identifier: Apache-2.0
#include "rt/check.hpp"

#include <algorithm>
#include <iterator>

namespace plumb::drivers::rt {
namespace {

void append(std::vector<Check>& all, std::vector<Check> more) {
  std::move(more.begin(), more.end(), std::back_inserter(all));
}

bool hinders(const Check& check, int cycle_us) {
  const bool decides = check.need == Need::kShortCycle && cycle_us <= kShortCycle_us;
  return check.need == Need::kAlways ? check.finding.grant != Grant::kGranted
                                     : decides && check.finding.grant == Grant::kDenied;
}

}  // namespace

const char* to_string(Need need) {
  switch (need) {
    case Need::kAlways:
      return "always";
    case Need::kShortCycle:
      return "short cycle";
    case Need::kAdvice:
      return "advice";
  }
  return "advice";
}

Check step_check(std::string id, Need need, std::span<const RtStep> steps, RtStepKind kind) {
  const auto it = std::find_if(steps.begin(), steps.end(),
                               [kind](const RtStep& step) { return step.kind == kind; });
  Check out{.id = std::move(id),
            .need = need,
            .finding = describe(it == steps.end() ? RtStep{.kind = kind} : *it)};
  if (out.finding.grant == Grant::kSkipped) out.finding.why = out.finding.what + " was not tried";
  return out;
}

std::vector<Check> examine(const MachineFiles& files, std::span<const RtStep> steps,
                           std::span<const CanInterface> can) {
  std::vector<Check> out = kernel_checks(files);
  append(out, process_checks(files, steps));
  append(out, processor_checks(files, steps));
  append(out, can_checks(can));
  return out;
}

std::vector<Check> obstacles(const std::vector<Check>& checks, int cycle_us) {
  std::vector<Check> out;
  std::copy_if(checks.begin(), checks.end(), std::back_inserter(out),
               [&](const Check& check) { return hinders(check, cycle_us); });
  return out;
}

}  // namespace plumb::drivers::rt
