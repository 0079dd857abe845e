// SPDX-License-Identifier: Apache-2.0
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ctime>
#include <memory>
#include <optional>

#include "bus_text/dbc.hpp"
#include "bus_text/modbus_map.hpp"
#include "cli/bus_output.hpp"
#include "cli/cell_data.hpp"
#include "cli/compiled.hpp"
#include "cli/model_file.hpp"
#include "cli/verbs.hpp"
#include "deploy/bus_of_cell.hpp"
#include "deploy/deploy_folder.hpp"
#include "deploy/rt_toml.hpp"
#include "plumb/drivers/bus_content.hpp"
#include "plumb/drivers/sensor_places.hpp"
#include "plumb/drivers/session.hpp"
#include "plumb/drivers/session_transition.hpp"
#include "plumb/runtime/detail/effect_set.hpp"
#include "program/file.hpp"
#include "program/key_file.hpp"
#include "program/shell_word.hpp"
#include "program/sums_signature.hpp"
#include "show/audit_view.hpp"
#include "show/cost_view.hpp"

namespace plumb::offline::cli {
namespace {

namespace fs = std::filesystem;

struct DeployArguments {
  std::string folder;
  std::string mode = "shadow";
  std::string key;  // file of the private key; empty: the folder is not signed
  bool allow_slow = false;
  CompileOptions compile;
  WriteOptions write;
};

void refuse_existing(const DeployArguments& options) {
  if (!fs::exists(options.folder)) return;
  if (!fs::is_directory(options.folder))
    throw Failure(Exit::kUsage, {.code = "E-EXISTS",
                                 .message = fmt::format("{} is a file", options.folder),
                                 .help = "name a folder, for example: plumb deploy -o deploy"});
  if (!options.write.force)
    throw Failure(Exit::kUsage, {.code = "E-EXISTS",
                                 .message = fmt::format("{} is already there", options.folder),
                                 .help = "to replace its files, rt.toml too, add --force"});
}

/// Warns of temperatures that the model reads and the bus does not carry.
void warn_of_temperatures(const format::Model& model, const drivers::BusLayout& layout,
                          Outcome& outcome) {
  const auto missing = drivers::sensors_missing(layout, model);
  if (missing.empty()) return;
  std::vector<std::string> needed;
  for (int k = 0; const std::string* name = temperature_name(model, k); ++k)
    needed.push_back(*name);
  outcome.remarks.push_back(
      {.severity = Severity::kWarning,
       .code = "W-DEPLOY-TEMPERATURES",
       .message = fmt::format("the model listens to {}, which the bus does not bring: it will use "
                              "its fallback",
                              fmt::join(missing, ", ")),
       .help = fmt::format("[deploy.bus] temperatures = [\"{}\"]", fmt::join(needed, "\", \""))});
}

drivers::CorrectionMode mode_of(const DeployArguments& options) {
  for (const auto mode : {drivers::CorrectionMode::kLimited, drivers::CorrectionMode::kFull})
    if (options.mode == drivers::to_string(mode)) return mode;
  return drivers::CorrectionMode::kShadow;
}

/// What plumb-rt will send in this mode, and how it is changed.
std::string mode_text(const DeployArguments& options) {
  const drivers::ShareSettings share;
  const std::string file = (fs::path(options.folder) / "rt.toml").string();
  const std::string change = fmt::format(
      "to change it: deploy again with --mode and --force, or [limits] mode in {}", file);
  switch (mode_of(options)) {
    case drivers::CorrectionMode::kFull:
      return "Mode full: the whole correction is sent; " + change;
    case drivers::CorrectionMode::kLimited:
      return fmt::format("Mode limited: {:g} of the correction is sent, at most {:g} mm; {}",
                         share.limited_scale, 1e3 * share.limited_m, change);
    case drivers::CorrectionMode::kShadow:
      break;
  }
  return "Mode shadow: computes and reports, sends no correction; " + change;
}

/// Refuses a model whose step does not fit the cycle; warns with --allow-slow.
void judge_cycle(const DeployArguments& options, const bench::StepCost& cost, double cycle_s,
                 Outcome& outcome) {
  const std::string fault = bench::cycle_fault(cost, cycle_s);
  if (fault.empty()) return;
  if (options.allow_slow)
    return outcome.remark({{.severity = Severity::kWarning,
                            .code = "W-DEPLOY-CYCLE",
                            .message = fault,
                            .help = "time it on the controller-side PC: plumb bench robot.plumb"}});
  throw Failure(Exit::kNumbersSayNo,
                {.code = "E-DEPLOY-CYCLE",
                 .message = fault,
                 .help = "a longer [deploy] cycle_us, or fewer effects (plumb bench says what each "
                         "costs); for a faster PC than this one: --allow-slow"});
}

/// The time of now in UTC, to the second.
std::string made_now() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

std::vector<DeployFile> files_of(const Cell& cell, const drivers::BusLayout& layout,
                                 const format::GuardLimits& guard, const std::string& model,
                                 drivers::CorrectionMode mode) {
  return {{"robot.plumb", model},
          {"bus.dbc", drivers::write_dbc(layout, about(cell))},
          {"modbus-map.md", drivers::modbus_map_markdown(layout, about(cell))},
          {"rt.toml", write_rt_toml(cell, layout, guard, mode, made_now())}};
}

void put_result(const DeployArguments& options, const Cell& cell, const drivers::BusLayout& layout,
                const std::vector<DeployFile>& files, const std::string& bytes,
                const format::Model& model, const SecretKey* key, Outcome& outcome) {
  Json names = Json::array();
  for (const auto& file : files) names.push_back((fs::path(options.folder) / file.name).string());
  names.push_back((fs::path(options.folder) / kSumsFile).string());
  if (key != nullptr) names.push_back((fs::path(options.folder) / kSignatureFile).string());
  outcome.result["folder"] = options.folder;
  outcome.result["files"] = names;
  outcome.result["dry_run"] = options.write.dry_run;
  outcome.result["robot_number"] = drivers::fingerprint(cell.serial);
  outcome.result["model_number"] = drivers::fingerprint(sha256(bytes));
  outcome.result["mode"] = options.mode;
  outcome.result["key_id"] = key == nullptr ? "" : key->public_key().id();
  outcome.result["max_correction_mm"] = 1e3 * model.guard.max_correction_m;
  put(outcome.result, "worst_bus_load_pct", 100.0 * drivers::worst_bus_load(layout));
}

std::string next_steps(const DeployArguments& options, const Cell& cell, const SecretKey* key) {
  return fmt::format(
      "The controller sends {} in message robot: it stands for serial {}.\n{}.\n\n{}, {}\n\n"
      "Then, on the controller-side PC:\n  plumb-rt run {}\n"
      "or, for a service there:\n  sudo plumb-rt install {} --to NAME\n",
      drivers::fingerprint(cell.serial), cell.serial.empty() ? "\"\"" : cell.serial,
      mode_text(options), wrote(options.folder, options.write),
      key == nullptr ? "unsigned" : "signed by key " + key->public_key().id(),
      shell_word(options.folder), shell_word(options.folder));
}

void deploy(const DeployArguments& options, const Globals& globals, Outcome& outcome) {
  Cell cell = open_cell(globals, outcome);
  refuse_existing(options);
  std::optional<SecretKey> secret;
  if (!options.key.empty()) secret.emplace(read_secret_key(options.key));
  const SecretKey* const key = secret ? &*secret : nullptr;
  const drivers::BusLayout layout = bus_of(cell, cell.deploy.link);
  const Compiled made = compiled(cell, options.compile, options.write, outcome);
  const format::Model& model = made.model;
  const Audit found = audit(model);
  outcome.remark(found.remarks);
  warn_of_temperatures(model, layout, outcome);
  made.put_run(outcome.result);
  outcome.result["audit"] = show::audit_json(found, model);
  const bench::StepCost cost = bench::step_cost(model);
  outcome.result["cost"] = show::cost_json(cost);
  outcome.text = compiled_headline(made, cell.tolerance_m) + show::audit_text(found, model) +
                 show::cost_text(cost);
  judge_cycle(options, cost, cell.deploy.cycle_s, outcome);
  if (options.compile.gate) check_gate(found, made, cell.tolerance_m, outcome);
  if (!outcome.errors.empty()) return;
  const std::string bytes = model_bytes(model);
  const auto files = files_of(cell, layout, model.guard, bytes, mode_of(options));
  put_result(options, cell, layout, files, bytes, model, key, outcome);
  const auto note = folder_note(options.folder, options.write);
  if (!options.write.dry_run) write_deploy_folder(options.folder, files, key);
  if (note) outcome.remark({*note});
  outcome.text += "\n" + next_steps(options, cell, key);
}

}  // namespace

void add_deploy(Program& program) {
  const auto options = std::make_shared<DeployArguments>();
  VerbOptions verb = program.verb(
      {.name = "deploy",
       .summary = "Everything plumb-rt needs in one folder: model, rt.toml, DBC, Modbus map, sums",
       .examples =
           "  plumb deploy -o deploy\n  plumb -C mycell deploy -o deploy --mode limited --force"},
      [options](const Globals& g, Outcome& o) { deploy(*options, g, o); });
  verb.add_option("-o,--output", options->folder, "Folder to write").type_name("DIR").required();
  verb.add_option("--mode", options->mode, "What plumb-rt sends: nothing, a capped part, or all")
      .check(one_of({"shadow", "limited", "full"}))
      .shows_default();
  verb.add_option("--sign", options->key,
                  "Sign the folder with the private key in FILE.key, which plumb keygen makes")
      .type_name("FILE");
  verb.add_flag("--allow-slow", options->allow_slow,
                "Write although a step takes more than half of the cycle on this machine");
  options->compile.add_to(verb);
  options->write.add_to(verb);
}

}  // namespace plumb::offline::cli
