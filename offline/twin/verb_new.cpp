// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "bus_text/bus_arm.hpp"
#include "plumb/drivers/sensor_places.hpp"
#include "program/output_files.hpp"
#include "simulate/hidden_effect_reader.hpp"
#include "twin/surroundings.hpp"
#include "twin/twin_file.hpp"
#include "twin/verbs.hpp"

namespace plumb::offline::twin {
namespace {

namespace fs = std::filesystem;

struct NewArguments {
  std::string directory;
  std::string robot = "six-axis";
  std::vector<std::string> hidden;
  std::uint64_t seed = 1;
  double noise_um = 10.0;
  double geometry_um = 300.0, geometry_urad = 300.0;
  WriteOptions write;
};

/// A robot to choose from. It takes its arm, and in most cases its hidden effect, from a sample
/// cell of plumb demo.
struct Robot {
  const char* name;
  const char* demo;
  const char* hides;
};
constexpr Robot kRobots[] = {
    {"six-axis", "clean", "joint_compliance:J2=150urad,J3=150urad"},
    {"heavy", "compliance", "joint_compliance:J2=150urad,J3=150urad"},
    {"light", "gear", "gear_harmonics:J2=150urad,J3=150urad"},
    {"scara", "scara", "gear_harmonics:J1=100urad,J2=100urad"},
};

std::vector<std::string> robot_names() {
  std::vector<std::string> out;
  for (const auto& robot : kRobots) out.emplace_back(robot.name);
  return out;
}

const Robot& find_robot(const std::string& name) {
  for (const auto& robot : kRobots)
    if (robot.name == name) return robot;
  return kRobots[0];
}

/// The tracker is aligned to the base of the arm, and its reflector is at the tool centre point, so
/// that an error of the tool can be stated in the base frame.
Cell cell_of(const Robot& robot, const NewArguments& options) {
  Cell cell = make_demo(robot.demo).cell;
  cell.directory = fs::absolute(options.directory);
  cell.name = fmt::format("Twin: {} arm", robot.name);
  cell.serial = fmt::format("TWIN-{}", options.seed);
  auto& measurement = cell.measurement;
  measurement.files = {cell.directory / "measurements.csv"};
  measurement.fit_frame = measurement.fit_target = false;
  measurement.X_MB = {{2.5, -3.0, 0.4}, {0.5, 0.0, 0.0, 0.8660254037844386}};
  measurement.target_T = {0.0, 0.0, 0.0};
  measurement.sigma_m = options.noise_um * 1e-6;
  cell.deploy.max_correction_m = 0.006;
  cell.deploy.interface = "vcan0";
  return cell;
}

std::string next_steps(const std::string& folder) {
  return fmt::format(
      "\nNext, type\n"
      "  plumb-twin measure {0}\n"
      "  plumb -C {0} diagnose --apply\n"
      "  plumb -C {0} compile\n"
      "  plumb -C {0} deploy -o {0}/deploy --mode full\n"
      "  plumb-rt run {0}/deploy &\n"
      "  plumb-twin run {0} --can vcan0\n",
      folder);
}

/// Adds the temperatures to the bus layout if an effect needs them; the default layout has none.
/// Throws Failure (kUsage) for an unknown effect.
void report_temperatures(const Hidden& hidden, Cell& cell) {
  std::vector<HiddenEffect> effects;
  for (const auto& effect : hidden.effects) effects.push_back(parse_hidden_effect(effect, cell));
  if (!needs_temperatures(effects)) return;
  drivers::BusLayout layout =
      drivers::arm_layout(drivers::bus_arm(cell.nominal, cell.deploy.cycle_s),
                          static_cast<int>(hidden.sensors.size()), drivers::CorrectionForm::kPose);
  drivers::name_temperatures(hidden.sensors, layout);
  cell.deploy.bus = std::make_shared<const drivers::BusLayout>(std::move(layout));
}

void make(const NewArguments& options, Outcome& outcome) {
  const Robot& robot = find_robot(options.robot);
  Cell cell = cell_of(robot, options);
  Hidden hidden{.seed = options.seed,
                .effects = options.hidden,
                .geometry_m = options.geometry_um * 1e-6,
                .geometry_rad = options.geometry_urad * 1e-6,
                .noise_m = options.noise_um * 1e-6};
  if (hidden.effects.empty()) hidden.effects = {robot.hides};
  report_temperatures(hidden, cell);
  const fs::path folder = options.directory;
  OutputFiles files(folder);
  files.add(folder / "cell.toml", write_cell(cell));
  files.add(folder / "twin.toml", write_hidden(hidden));
  outcome.result = {{"directory", folder.string()},
                    {"robot", options.robot},
                    {"hidden", hidden.effects},
                    {"seed", hidden.seed}};
  files.commit(options.write, outcome);
  outcome.text = fmt::format("{}: what it hides stands in twin.toml.\n\n  {}\n", cell.name,
                             wrote(folder / "{cell.toml,twin.toml}", options.write));
  outcome.text += next_steps(folder.string());
}

}  // namespace

void add_new(Program& program) {
  const auto options = std::make_shared<NewArguments>();
  VerbOptions verb = program.verb(
      {.name = "new",
       .summary = "Write a cell and what its arm hides",
       .examples = "  plumb-twin new mytwin\n"
                   "  plumb-twin new mytwin --robot heavy --hidden gear_ripple:J2=40urad --seed 7"},
      [options](const Globals&, Outcome& o) { make(*options, o); });
  verb.add_option("DIR", options->directory, "Folder to write into").required();
  verb.add_option("--robot", options->robot, "Which arm")
      .check(one_of(robot_names()))
      .shows_default();
  verb.add_option("--hidden,--effect", options->hidden,
                  "Effect that the nominal model lacks; may be repeated; see plumb simulate --list")
      .type_name("EFFECT");
  verb.add_option("--seed", options->seed, "Of arm, poses and noise").shows_default();
  verb.add_option("--noise-um", options->noise_um, "Noise of the tracker per axis, 1 sigma")
      .check(number_between(0.01, 1e4))
      .shows_default();
  verb.add_option("--geometry-um", options->geometry_um, "1 sigma of every length error")
      .check(number_between(0.0, 1e5))
      .shows_default();
  verb.add_option("--geometry-urad", options->geometry_urad, "1 sigma of every angle error")
      .check(number_between(0.0, 1e5))
      .shows_default();
  options->write.add_to(verb);
}

}  // namespace plumb::offline::twin
