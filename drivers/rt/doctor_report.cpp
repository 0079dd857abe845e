// SPDX-License-Identifier: Apache-2.0
#include "rt/doctor_report.hpp"

#include <fmt/format.h>

namespace plumb::drivers::rt {
namespace {

std::string cycle(int cycle_us) {
  return cycle_us % 1000 == 0 ? fmt::format("{} ms", cycle_us / 1000)
                              : fmt::format("{} us", cycle_us);
}

/// Writes a whole number; without one, null and the reason under "<key>_reason".
void put_whole(Json& out, const std::string& key, const std::optional<std::uint32_t>& value,
               const char* reason) {
  out[key] = value ? Json(*value) : Json(nullptr);
  if (!value) out[key + "_reason"] = reason;
}

Json can_json(const CanInterface& one) {
  const char* const reason = one.kind == "can"  ? "not set"
                             : one.kind.empty() ? "not in the files of a machine"
                                                : "a virtual interface has none";
  Json out{
      {"name", one.name}, {"kind", one.kind}, {"state", to_string(state_of(one))}, {"fd", one.fd}};
  put_whole(out, "bit_rate", one.bit_rate, reason);
  put_whole(out, "data_bit_rate", one.data_bit_rate, reason);
  put_whole(out, "restart_ms", one.restart_ms, reason);
  return out;
}

Json can_json(const std::vector<CanInterface>& interfaces) {
  Json out = Json::array();
  for (const CanInterface& one : interfaces) out.push_back(can_json(one));
  return out;
}

}  // namespace

std::string verdict(const Examination& examination) {
  std::string out = fmt::format("fit for a {} cycle: ", cycle(examination.cycle_us));
  const auto against = obstacles(examination.checks, examination.cycle_us);
  if (against.empty()) return out + "yes";
  out += "no, because ";
  for (std::size_t i = 0; i < against.size(); ++i)
    out += (i == 0 ? "" : "; and because ") + against[i].finding.why;
  return out;
}

std::string to_text(const Examination& examination) {
  std::string out;
  for (const auto& [id, need, finding] : examination.checks) {
    out += fmt::format("{:<8} {:<15} {}\n", to_string(finding.grant), finding.what, finding.why);
    if (!finding.remedy.empty()) out += fmt::format("{:<24} > {}\n", "", finding.remedy);
  }
  return out + "\n" + verdict(examination) + "\n";
}

Json to_json(const Examination& examination) {
  Json checks = Json::array();
  for (const auto& [id, need, finding] : examination.checks)
    checks.push_back({{"check", id},
                      {"what", finding.what},
                      {"grant", to_string(finding.grant)},
                      {"needed", to_string(need)},
                      {"why", finding.why},
                      {"remedy", finding.remedy}});
  return {{"fit", examination.fit()},
          {"cycle_us", examination.cycle_us},
          {"verdict", verdict(examination)},
          {"checks", checks},
          {"can_interfaces", can_json(examination.can)}};
}

}  // namespace plumb::drivers::rt
