// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdio>

#include "cell/cell.hpp"
#include "support.hpp"

namespace plumb::offline {
namespace {

constexpr double kDeg = M_PI / 180.0;

/// The example of the interface, with what this version can fit; its second joint runs over two
/// lines.
const std::string kExample = R"(schema = "cell/1"
[cell]
name = "Drilling cell 4"
serial = "F08-1234"                     # bound into compiled models
tolerance_mm = 0.20

[robot]
name = "Staubli TX200"
dh_convention = "modified"              # required: "standard" (distal) or "modified" (Craig)
length_unit = "mm"
angle_unit = "deg"
joints = [                              # nominal values; q limits in the same unit
  { name = "J1", alpha = 0.0,   a = 0.0,   d = 642.0, theta = 0.0,   q = [-180, 180] },
  { name = "J2", alpha = -90.0, a = 250.0, d = 450.0, theta = -90.0, q = [-115, 120], parallel_next = true,
    gear_ratio = 171, stiffness_Nm_per_rad = 4.0e6 },      # optional, for effects
]
gravity = [0, 9.81, 0]
base = { xyz = [10, 0, 0], rpy = [0, 0, 90] }
tool = { xyz = [0, 0, 150], rpy = [0, 0, 0] }
payload = { mass_kg = 60, com_mm = [30, 10, 80] }
[[robot.links]]
joint = "J2"
mass_kg = 220
com_mm = [400, 0, 0]

[measurement]
files = ["measurements.csv"]
frame = "fit"
target = [1, 2, 3]
sigma_um = 10
held_out = "kfold:7"
seed = 12

[effects]
geometry = true
[effects.local_tree]
min_gain = "2%"

[fit]
model = "complete"
fixed = ["J2.d"]

[deploy]
cycle_us = 4000
max_correction_mm = 2.5
)";

Cell read(const std::string& text) { return parse_cell(text, "/c/cell.toml"); }

TEST(Cell, HoldsTheCouplingOfItsJoints) {
  const std::string robot =
      "schema = \"cell/1\"\n[robot]\ndh_convention = \"standard\"\n"
      "joints = [{ q = [-90, 90] }, { q = [-90, 90] }, { q = [-90, 90] }]\n";
  const Cell c = read(robot +
                      "coupling = [{ joint = \"J3\", of = \"J2\", share = 1.0 },\n"
                      "{ joint = \"J2\", of = \"J1\", share = -0.5 }]\n");
  EXPECT_EQ(c.nominal.coupling, (std::vector<format::JointCoupling>{{2, 1, -1.0}, {1, 0, 0.5}}));
  EXPECT_EQ(read(write_cell(c)).nominal.coupling, c.nominal.coupling);
  EXPECT_NE(fit_hash(c), fit_hash(read(robot)));
}

TEST(Cell, OfTheInterfaceIsReadInSi) {
  const Folder folder;
  const auto file = folder.put("cell.toml", kExample);
  const Cell c = read_cell(file);
  EXPECT_EQ(c.file, file);
  EXPECT_EQ(c.directory, folder.path());
  EXPECT_EQ(c.text, kExample);
  EXPECT_EQ(c.name, "Drilling cell 4");
  EXPECT_EQ(c.serial, "F08-1234");
  EXPECT_EQ(c.tolerance_m, 0.0002);
  EXPECT_EQ(c.nominal.convention, format::Convention::kModified);
  ASSERT_EQ(c.joints(), 2);
  const auto& j2 = c.nominal.joints[1];
  EXPECT_DOUBLE_EQ(j2.alpha, -90 * kDeg);
  EXPECT_EQ(j2.a, 0.25);
  EXPECT_EQ(j2.d, 0.45);
  EXPECT_DOUBLE_EQ(j2.q_min, -115 * kDeg);
  EXPECT_DOUBLE_EQ(j2.q_max, 120 * kDeg);
  EXPECT_TRUE(c.mechanics[1].parallel_next);
  EXPECT_EQ(c.mechanics[1].gear_ratio, 171.0);
  EXPECT_EQ(c.mechanics[1].stiffness_Nm_per_rad, 4e6);
  EXPECT_EQ(c.mechanics[1].link_mass_kg, 220.0);
  EXPECT_EQ(c.mechanics[1].link_com_m, (std::array<double, 3>{0.4, 0, 0}));
  EXPECT_EQ(c.gravity, (std::array<double, 3>{0, 9.81, 0}));
  EXPECT_EQ(c.nominal.base.p[0], 0.01);
  EXPECT_NEAR(c.nominal.base.q[3], std::sqrt(0.5), 1e-15);
  EXPECT_EQ(c.nominal.tool.p[2], 0.15);
  EXPECT_EQ(c.payload.com_m, (std::array<double, 3>{0.03, 0.01, 0.08}));
  EXPECT_EQ(c.measurement.files.at(0), folder.path() / "measurements.csv");
  EXPECT_TRUE(c.measurement.fit_frame);
  EXPECT_FALSE(c.measurement.fit_target);
  EXPECT_EQ(c.measurement.target_T, (std::array<double, 3>{0.001, 0.002, 0.003}));
  EXPECT_EQ(c.measurement.sigma_m, 1e-5);
  EXPECT_EQ(c.measurement.held_out.kind, HeldOutRule::Kind::kFolds);
  EXPECT_EQ(c.measurement.held_out.folds, 7);
  EXPECT_EQ(c.measurement.seed, 12u);
  ASSERT_EQ(c.effects.size(), 2u);
  EXPECT_EQ(c.effects[0].name, "geometry");
  EXPECT_EQ(c.effects[1].name, "local_tree");
  EXPECT_EQ(std::get<double>(c.effects[1].options.at("min_gain")), 0.02);
  EXPECT_EQ(c.effects[1].place.line, 36);
  EXPECT_EQ(c.fit.model, FitSettings::Model::kComplete);
  EXPECT_EQ(c.fit.fixed, std::vector<std::string>{"J2.d"});
  EXPECT_EQ(c.deploy.cycle_s, 0.004);
  EXPECT_EQ(c.deploy.max_correction_m, 0.0025);
  EXPECT_TRUE(c.remarks.empty());
}

TEST(Cell, HasDefaultsForAllButTheArm) {
  const Cell c = read(
      "schema = \"cell/1\"\n[robot]\ndh_convention = \"standard\"\njoints = [{ q = [-90, 90] }]\n");
  EXPECT_EQ(c.tolerance_m, 1e-4);
  EXPECT_EQ(c.nominal.joints[0].name, "J1");
  EXPECT_EQ(c.nominal.joints[0].scale, 1.0);
  EXPECT_EQ(c.gravity, (std::array<double, 3>{0, 0, -9.81}));
  EXPECT_EQ(c.measurement.files, std::vector{c.directory / "measurements.csv"});
  EXPECT_TRUE(c.measurement.fit_frame && c.measurement.fit_target);
  EXPECT_EQ(c.measurement.held_out.kind, HeldOutRule::Kind::kAuto);
  ASSERT_EQ(c.effects.size(), 1u);
  EXPECT_EQ(c.effects[0].name, "geometry");
}

TEST(Cell, UsesTheUnitsOfItsFile) {
  const Cell c = read(
      "schema = \"cell/1\"\n[robot]\ndh_convention = \"standard\"\nlength_unit = "
      "\"in\"\nangle_unit = \"rad\"\n"
      "joints = [{ a = 10, alpha = 0.5, q = [-1, 2] },\n"
      "  { type = \"prismatic\", q = [0, 20], offset = 1, theta = 0.25 }]\n"
      "tool = { xyz = [1, 0, 0], rpy = [0.5, 0, 0] }\n"
      "[measurement]\ntarget = [0, 0, 2]\nframe = { xyz = [100, 0, 0] }\n");
  EXPECT_DOUBLE_EQ(c.nominal.joints[0].a, 0.254);
  EXPECT_EQ(c.nominal.joints[0].alpha, 0.5);
  EXPECT_EQ(c.nominal.joints[0].q_max, 2.0);
  EXPECT_DOUBLE_EQ(c.nominal.joints[1].q_max, 0.508);
  EXPECT_DOUBLE_EQ(c.nominal.joints[1].offset, 0.0254);
  EXPECT_EQ(c.nominal.joints[1].theta, 0.25);
  EXPECT_DOUBLE_EQ(c.nominal.tool.q[1], std::sin(0.25));
  EXPECT_DOUBLE_EQ(c.measurement.target_T[2], 0.0508);
  EXPECT_DOUBLE_EQ(c.measurement.X_MB.p[0], 2.54);
}

TEST(Cell, MayFitFrameAndTargetOnly) {
  const Cell c = read(
      "schema = \"cell/1\"\n[robot]\ndh_convention = \"standard\"\njoints = "
      "[{}]\n[effects]\ngeometry = false\n");
  EXPECT_TRUE(c.effects.empty());
}

TEST(HeldOut, RulesAreRead) {
  using Kind = HeldOutRule::Kind;
  EXPECT_EQ(parse_held_out("20%", "/c")->share, 0.2);
  EXPECT_EQ(parse_held_out("0.5%", "/c")->kind, Kind::kShare);
  EXPECT_EQ(parse_held_out("kfold:5", "/c")->folds, 5);
  EXPECT_EQ(parse_held_out("column:set", "/c")->column, "set");
  EXPECT_EQ(parse_held_out("file:../v.csv", "/c/d")->file, "/c/v.csv");
}

TEST(Cell, TruncatedAtEveryByteIsAlwaysReadOrExplained) {
  int read = 0, refused = 0;
  for (std::size_t i = 0; i <= kExample.size(); ++i) {
    const auto problems = problems_of([&] { parse_cell(kExample.substr(0, i), "/c/cell.toml"); });
    for (const auto& p : problems) EXPECT_FALSE(render(p).empty());
    ++(problems.empty() ? read : refused);
  }
  EXPECT_GT(read, 50);
  EXPECT_GT(refused, 100);
}

TEST(Cell, WithAnyByteChangedIsAlwaysReadOrExplained) {
  constexpr int kCount = 4000;
  constexpr unsigned kSeed = 11;
  std::printf("%d changes, seed %u\n", kCount, kSeed);
  unsigned state = kSeed;
  const auto next = [&] { return state = state * 1664525u + 1013904223u; };
  for (int i = 0; i < kCount; ++i) {
    std::string text = kExample;
    const char* const alphabet = "{}[]\"'=,.#\n\\0\xC3 -";
    text[(next() >> 8) % text.size()] = alphabet[(next() >> 8) % 17];
    for (const auto& p : problems_of([&] { parse_cell(text, "/c/cell.toml"); }))
      EXPECT_FALSE(render(p).empty());
  }
}

}  // namespace
}  // namespace plumb::offline
