// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "simulate/arm_rows.hpp"
#include "simulate/planar.hpp"
#include "simulate/simulate.hpp"
#include "simulate/study_arms.hpp"

namespace plumb::offline {
namespace {

using format::Convention;
using format::JointType;
using sim::SheetRow;

constexpr int kPoses = 200;

SimulationPlan usual_plan(std::vector<std::string> effects) {
  SimulationPlan plan;
  plan.poses = kPoses;
  plan.repeats = 3;
  plan.truth.geometry_m = 0.3e-3;
  plan.truth.geometry_rad = 0.3e-3;
  plan.truth.effects = std::move(effects);
  return plan;
}

void label(Cell& cell, const std::string& name, const std::string& serial,
           const std::string& robot) {
  cell.name = name;
  cell.serial = serial;
  cell.robot_name = robot;
}

Demo heavy(const std::string& title, const std::string& serial, const std::string& effect) {
  Cell cell = sim::heavy_arm();
  label(cell, title, serial, "Heavy six-axis arm, TX200-like");
  cell.payload = {60.0, {0.03, 0.01, 0.08}};
  return {cell, usual_plan({effect})};
}

Demo light(const std::string& title, const std::string& serial, const std::string& effect) {
  Cell cell = sim::light_arm();
  label(cell, title, serial, "Light six-axis arm, UR10-like");
  cell.payload = {2.0, {0.0, 0.0, 0.05}};
  return {cell, usual_plan({effect})};
}

Demo compliance() {
  return heavy("Demo: heavy arm", "DEMO-COMPLIANCE", "joint_compliance:J2=150urad,J3=150urad");
}

Demo gear() {
  return light("Demo: collaborative arm", "DEMO-GEAR", "gear_harmonics:J2=150urad,J3=150urad");
}

Demo ripple() { return light("Demo: tooth mesh", "DEMO-RIPPLE", "gear_ripple:J2:5@cycles=20"); }

Demo bumped() { return heavy("Demo: bumped reflector", "DEMO-BUMPED", "step_reflector::8@at=0.6"); }

Demo reversal() {
  Demo demo = light("Demo: backlash", "DEMO-REVERSAL", "reversal:J2,J3:4");
  demo.plan.choice.order = PoseChoice::Order::kNearest;
  return demo;
}

Demo thermal() {
  Demo demo = heavy("Demo: warming up", "DEMO-THERMAL", "thermal_growth::4");
  demo.plan.seconds_per_pose = 45.0;
  return demo;
}

Demo unknown() { return light("Demo: nobody knows", "DEMO-UNKNOWN", "joint_product:J5:5@a=4,b=6"); }

Demo mixed() {
  Demo demo = heavy("Demo: three at once", "DEMO-MIXED", "joint_compliance:J2,J3:5");
  for (const char* more : {"gear_harmonics:J1:2", "drift::2"})
    demo.plan.truth.effects.emplace_back(more);
  demo.plan.outlier_share = 0.01;
  return demo;
}

Demo scara() {
  Cell cell = sim::cell_from_sheet(
      Convention::kStandard,
      {{.a_mm = 400, .d_mm = 350, .q_min = -130, .q_max = 130, .parallel_next = true},
       {.alpha_deg = 180, .a_mm = 350, .q_min = -145, .q_max = 145, .parallel_next = true},
       {.q_min = 20, .q_max = 220, .type = JointType::kPrismatic, .parallel_next = true},
       {.d_mm = 40, .q_min = -180, .q_max = 180}},
      80);
  label(cell, "Demo: SCARA", "DEMO-SCARA", "Four-axis SCARA");
  return {cell, usual_plan({"gear_harmonics:J1=100urad,J2=100urad"})};
}

Demo clean() {
  Cell cell =
      sim::cell_from_sheet(Convention::kStandard,
                           {{-90, 25, 400, 0, -170, 170},
                            {.a_mm = 455, .q_min = -190, .q_max = 45, .parallel_next = true},
                            {90, 35, 0, 90, -120, 156},
                            {-90, 0, 420, 0, -180, 180},
                            {90, 0, 0, 0, -120, 120},
                            {0, 0, 80, 0, -180, 180}},
                           100);
  label(cell, "Demo: nothing hidden", "DEMO-CLEAN", "Small six-axis arm");
  cell.payload = {3.0, {0.0, 0.0, 0.05}};
  return {cell, usual_plan({})};
}

Demo planar(PlanarVariant variant, const std::string& law) {
  SimulationPlan plan;
  plan.q = planar_grid(0.1);
  plan.axes = {true, true, false};
  plan.truth.effects = {law};
  return {planar_cell(variant), plan};
}

Demo beam() {
  Demo demo = planar(PlanarVariant::kPrinted, "planar_printed");
  demo.plan.q.resize(0, 0);
  demo.plan.poses = kPoses;
  demo.plan.repeats = 3;
  return demo;
}

struct Entry {
  std::string name;
  std::string line;
  Demo (*make)();
};

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all{
      {"compliance", "heavy six-axis arm whose second and third joint yield under gravity",
       compliance},
      {"gear", "light six-axis arm with gear errors once and twice a turn", gear},
      {"ripple", "light six-axis arm, tooth mesh of the second gear: 20 cycles a turn", ripple},
      {"bumped", "heavy arm whose reflector slipped on the way", bumped},
      {"reversal", "light arm that stops short by the side it comes from", reversal},
      {"thermal", "heavy arm that grows as it warms up", thermal},
      {"unknown", "light arm whose fifth joint errs with the fourth and sixth together", unknown},
      {"mixed", "heavy arm with three effects and a few gross outliers", mixed},
      {"beam", "planar arm whose links bend, 200 random poses", beam},
      {"scara", "four joints, one of them slides; gear errors", scara},
      {"clean", "six-axis arm with nothing hidden but its geometry", clean},
      {"planar-published", "planar arm of the study as its printed figures need it, 1536 poses",
       [] { return planar(PlanarVariant::kPublished, "planar_published"); }},
      {"planar-printed", "planar arm of the study as printed, correct statics, 1536 poses",
       [] { return planar(PlanarVariant::kPrinted, "planar_printed"); }},
  };
  return all;
}

}  // namespace

const std::vector<std::pair<std::string, std::string>>& demo_cells() {
  static const auto lines = [] {
    std::vector<std::pair<std::string, std::string>> out;
    for (const auto& entry : entries()) out.emplace_back(entry.name, entry.line);
    return out;
  }();
  return lines;
}

Demo make_demo(const std::string& name) {
  if (name.empty()) return entries().front().make();
  std::vector<std::string> names;
  for (const auto& entry : entries()) {
    if (entry.name == name) return entry.make();
    names.push_back(entry.name);
  }
  const auto near = did_you_mean(name, names);
  std::string known;
  for (const auto& each : names) known += (known.empty() ? "" : ", ") + each;
  throw Failure(Exit::kUsage,
                {Severity::kError, "E-DEMO-NAME", "there is no demo '" + name + "'", std::nullopt,
                 near ? "did you mean '" + *near + "'?" : "known: " + known});
}

}  // namespace plumb::offline
