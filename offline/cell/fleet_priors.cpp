// SPDX-License-Identifier: Apache-2.0
#include "cell/fleet_priors.hpp"

#include <fmt/format.h>

#include "program/bounded_file.hpp"
#include "program/file.hpp"
#include "program/json.hpp"

namespace plumb::offline {
namespace {

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

std::vector<Prior> fleet_priors(const std::filesystem::path& file, const format::Chain& nominal) {
  std::vector<Prior> out;
  bool known = false;
  try {
    const Json json = Json::parse(read_regular_file(file, kMostFileBytes));
    if (json.at("schema") != "fleet/1") refuse(file, "is of another schema than fleet/1");
    const std::string key = model_key(nominal);
    for (const auto& model : json.at("models")) {
      if (model.at("key") != key) continue;
      known = true;
      for (const auto& t : model.at("typical"))
        out.push_back({.name = t.at("name"),
                       .sigma = t.at("sd_si"),
                       .mean = t.at("mean_si"),
                       .of_fleet = true});
    }
  } catch (const nlohmann::json::exception&) {
    refuse(file, "is no file of plumb fleet, or was cut off");
  }
  if (!known) refuse(file, "holds no arm with these DH values");
  return out;
}

std::string fleet_priors_text(const std::vector<Prior>& priors) {
  std::string out;
  for (const auto& prior : priors)
    if (prior.of_fleet) out += fmt::format("{} {} {}\n", prior.name, prior.mean, prior.sigma);
  return out;
}

}  // namespace plumb::offline
