// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rt/check.hpp"
#include "rt/signing_rules.hpp"

namespace plumb::drivers::rt {
namespace {

std::string key_names(const SigningRules& rules, KnownKey::Trust trust) {
  std::vector<std::string> names;
  for (const KnownKey& one : rules.keys.keys)
    if (one.trust == trust) names.push_back(one.name);
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

std::string demand_text(const SigningRules& rules) {
  if (!rules.demanded()) return rules.unsigned_note();
  const std::string keys =
      fmt::format("trusted keys: {}; revoked: {}", key_names(rules, KnownKey::Trust::kTrusted),
                  key_names(rules, KnownKey::Trust::kRevoked));
  const std::string note = rules.unsigned_note();
  return note.empty() ? "demanded; " + keys : "demanded, but " + note + "; " + keys;
}

}  // namespace

std::vector<Check> signing_checks(const std::filesystem::path& etc) {
  Check demand{.id = "signatures", .need = Need::kAdvice, .finding = {.what = "signatures"}};
  try {
    const SigningRules rules = read_signing_rules(etc);
    const bool strict = rules.unsigned_folders == SigningRules::Unsigned::kRefused;
    demand.finding.grant = strict             ? Grant::kGranted
                           : rules.demanded() ? Grant::kDenied
                                              : Grant::kSkipped;
    demand.finding.why = demand_text(rules);
    if (!strict)
      demand.finding.remedy = rules.demanded() ? "take unsigned = \"allowed\" out of " +
                                                     (etc / "plumb-rt.toml").string()
                                               : "sudo mkdir -p " + (etc / "keys.d").string() +
                                                     ", and put the .pub of your key there";
    std::vector<Check> out{demand};
    for (const Problem& problem : rules.keys.problems)
      out.push_back({.id = "key",
                     .need = Need::kAdvice,
                     .finding = {.what = "key",
                                 .grant = Grant::kDenied,
                                 .why = problem.message,
                                 .remedy = problem.help}});
    return out;
  } catch (const Failure& failure) {
    demand.finding.grant = Grant::kDenied;
    demand.finding.why = failure.problems().front().message;
    demand.finding.remedy = failure.problems().front().help;
    return {demand};
  }
}

}  // namespace plumb::drivers::rt
