// SPDX-License-Identifier: Apache-2.0
#include "cell/fleet_priors.hpp"

#include <fmt/format.h>

#include <cmath>

#include "program/bounded_file.hpp"
#include "program/file.hpp"
#include "program/json.hpp"

namespace plumb::offline {
namespace {

/// A larger number [SI] shows that the file was edited or damaged.
constexpr double kLargest = 1e6;

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  throw Failure(Exit::kInput, {.code = "E-CELL-PRIOR",
                               .message = fmt::format("{} {}", display_name(file), what),
                               .help = "make it: plumb fleet FOLDER; its fleet.json is meant"});
}

}  // namespace

std::string model_key(const format::Chain& nominal) {
  std::string text = nominal.convention == format::Convention::kStandard ? "s" : "m";
  for (const auto& row : nominal.joints)
    text += fmt::format(";{},{},{},{},{},{}", static_cast<int>(row.type), row.alpha, row.a, row.d,
                        row.theta, row.beta);
  return sha256(text).substr(0, 12);
}

FleetPriors fleet_priors(const std::filesystem::path& file, const format::Chain& nominal) {
  FleetPriors out;
  bool known = false;
  try {
    const Json json = Json::parse(read_regular_file(file, kMostFileBytes));
    if (json.at("schema") != "fleet/1") refuse(file, "is of another schema than fleet/1");
    const std::string key = model_key(nominal);
    for (const auto& model : json.at("models")) {
      if (model.at("key") != key) continue;
      known = true;
      for (const auto& t : model.at("typical"))
        out.priors.push_back({.name = t.at("name"),
                              .sigma = t.at("sd_si"),
                              .mean = t.at("mean_si"),
                              .of_fleet = true});
      for (const auto& one : model.at("shares"))
        out.odds.push_back({one.at("effect"), one.at("odds_nats")});
    }
  } catch (const nlohmann::json::exception&) {
    refuse(file, "is no file of plumb fleet, or was cut off");
  }
  for (const auto& prior : out.priors)
    if (!std::isfinite(prior.mean) || !(prior.sigma > 0.0) || !(prior.sigma < kLargest) ||
        std::abs(prior.mean) > kLargest)
      refuse(file, fmt::format("gives {} a value that no arm has", prior.name));
  for (const auto& one : out.odds)
    if (!(std::abs(one.nats) < kLargest))
      refuse(file, fmt::format("gives {} odds that no arm has", one.effect));
  if (!known) refuse(file, "holds no arm with these DH values");
  return out;
}

std::string fleet_priors_text(const FitSettings& settings) {
  std::string out;
  for (const auto& prior : settings.priors)
    if (prior.of_fleet) out += fmt::format("{} {} {}\n", prior.name, prior.mean, prior.sigma);
  for (const auto& [effect, nats] : settings.sister_odds)
    out += fmt::format("{} {}\n", effect, nats);
  return out;
}

}  // namespace plumb::offline
