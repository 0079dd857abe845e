// SPDX-License-Identifier: Apache-2.0
#include "twin/twin_file.hpp"

#include <fmt/format.h>

#include <cmath>

#include "program/file.hpp"
#include "program/json.hpp"
#include "program/toml_table.hpp"

namespace plumb::offline::twin {
namespace {

constexpr double kMicro = 1e-6;
constexpr const char* kSchema = "twin/1";

void read_arm(TomlTable& file, Hidden& out) {
  auto arm = file.table("arm");
  if (!arm) return;
  for (const auto& effect : arm->texts("effects")) out.effects.push_back(effect.text);
  if (const auto value = arm->not_negative("geometry_um")) out.geometry_m = *value * kMicro;
  if (const auto value = arm->not_negative("geometry_urad")) out.geometry_rad = *value * kMicro;
  arm->done();
}

void read_tracker(TomlTable& file, Hidden& out) {
  auto tracker = file.table("tracker");
  if (!tracker) return;
  if (const auto value = tracker->positive("noise_um")) out.noise_m = *value * kMicro;
  tracker->done();
}

void read_controller(TomlTable& file, Hidden& out) {
  auto controller = file.table("controller");
  if (!controller) return;
  if (controller->node("temperatures") != nullptr) out.sensors.clear();
  for (const auto& sensor : controller->texts("temperatures")) out.sensors.push_back(sensor.text);
  controller->done();
}

void read_seed(TomlTable& file, Hidden& out) {
  const auto seed = file.not_negative("seed");
  if (!seed) return;
  if (*seed != std::floor(*seed) || *seed > 0x1p53)
    return file.out_of_range("seed", "a whole number");
  out.seed = static_cast<std::uint64_t>(*seed);
}

/// "a", "b"
std::string quoted(const std::vector<std::string>& words) {
  std::string out;
  for (const auto& word : words) out += fmt::format("{}\"{}\"", out.empty() ? "" : ", ", word);
  return out;
}

[[noreturn]] void refuse_truth(const std::string& file_name) {
  throw Failure(
      Exit::kInput,
      {.code = "E-TWIN-TRUTH",
       .message = "it does not say how its arm can be simulated again: it was changed, or "
                  "simulated with more than effects and errors of geometry",
       .place = Place{.file = file_name},
       .help = "make a cell whose arm can be measured again: plumb demo compliance cell"});
}

}  // namespace

std::string write_hidden(const Hidden& hidden) {
  return fmt::format(
      "# What the twin's arm hides. No program but plumb-twin reads this file.\n"
      "schema = \"{}\"\n"
      "seed = {}\n\n"
      "[arm]\n"
      "effects = [{}]   # see: plumb simulate --list\n"
      "geometry_um = {}     # 1 sigma of every length error\n"
      "geometry_urad = {}   # 1 sigma of every angle error\n\n"
      "[tracker]\n"
      "noise_um = {}   # 1 sigma per axis\n\n"
      "[controller]\n"
      "temperatures = [{}]   # sensors it reports; in the order of a bus that does not name them\n",
      kSchema, hidden.seed, quoted(hidden.effects), hidden.geometry_m / kMicro,
      hidden.geometry_rad / kMicro, hidden.noise_m / kMicro, quoted(hidden.sensors));
}

Hidden parse_hidden(std::string text, const std::string& file_name) {
  TomlSource source(file_name, std::move(text), "E-TWIN");
  const toml::table root = source.parse();
  TomlTable file(root, "", source);
  Hidden out;
  file.choice("schema", {kSchema});
  read_seed(file, out);
  read_arm(file, out);
  read_tracker(file, out);
  read_controller(file, out);
  file.done();
  source.stop_on_errors();
  return out;
}

Hidden hidden_of_truth(std::string text, const std::string& file_name) {
  const Json truth = Json::parse(text, nullptr, false);
  if (!truth.is_object() || !truth.contains("arm")) refuse_truth(file_name);
  try {
    const Json& arm = truth.at("arm");
    Hidden out{.seed = truth.at("arm_seed"),
               .effects = arm.at("effects"),
               .geometry_m = double(arm.at("geometry_um")) * kMicro,
               .geometry_rad = double(arm.at("geometry_urad")) * kMicro,
               .noise_m = double(truth.at("noise_sigma_um")) * kMicro};
    out.axes = arm.at("axes");
    return out;
  } catch (const Json::exception&) {
    refuse_truth(file_name);
  }
}

TwinFolder open_folder(const std::filesystem::path& folder, Outcome& outcome) {
  const std::filesystem::path own = folder / "twin.toml", made = folder / "truth.json";
  const bool sample = !std::filesystem::exists(own) && std::filesystem::exists(made);
  const std::filesystem::path& twin = sample ? made : own;
  Cell cell = read_cell(folder / "cell.toml");
  outcome.inputs.push_back({cell.file.string(), sha256(cell.text)});
  outcome.remark(cell.remarks);
  const std::string text = read_file(twin);
  outcome.inputs.push_back({display_name(twin), sha256(text)});
  const auto read = sample ? hidden_of_truth : parse_hidden;
  return {std::move(cell), read(text, display_name(twin))};
}

HiddenTruth truth_of(const Cell& cell, const Hidden& hidden, std::optional<std::uint64_t> like) {
  SimulationPlan plan;
  plan.seed = hidden.seed;
  plan.noise_m = hidden.noise_m;
  plan.truth.geometry_m = hidden.geometry_m;
  plan.truth.geometry_rad = hidden.geometry_rad;
  plan.truth.effects = hidden.effects;
  plan.truth.seed = hidden.seed;
  plan.truth.like = like;
  const Simulation arm = simulate(cell, plan);
  HiddenTruth out = plan.truth;
  out.sized = arm.effects;
  out.effects.clear();
  out.X_MB = arm.X_MB;
  out.target_T = arm.X_TG.p;
  return out;
}

}  // namespace plumb::offline::twin
