// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdio>
#include <random>

#include "bus_text/bus_arm.hpp"
#include "cell/cell.hpp"
#include "cell/measurement_reader.hpp"
#include "cell/measurements.hpp"
#include "support.hpp"

namespace plumb::offline {
namespace {

constexpr int kCells = 200;
constexpr unsigned kSeed = 2;

class Dice {
 public:
  explicit Dice(unsigned seed) : random_(seed) {}
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  bool coin() { return below(2) == 0; }
  std::array<double, 3> vector(double size) {
    return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
  }
  format::Pose pose() {
    format::Pose out{vector(3.0), {}};
    double norm = 0.0;
    for (double& x : out.q) {
      x = uniform(-1, 1);
      norm += x * x;
    }
    for (double& x : out.q) x *= std::copysign(1.0, out.q[0]) / std::sqrt(norm);
    out.q[0] = std::abs(out.q[0]);
    return out;
  }

 private:
  std::mt19937 random_;
};

format::JointRow random_joint(Dice& dice, int i) {
  format::JointRow row;
  row.name = "axis" + std::to_string(i);
  row.type = dice.below(4) ? format::JointType::kRevolute : format::JointType::kPrismatic;
  row.alpha = dice.uniform(-3, 3);
  row.a = dice.uniform(-1, 1);
  row.d = dice.uniform(-1, 1);
  row.theta = dice.uniform(-3, 3);
  if (dice.coin()) row.beta = dice.uniform(-0.1, 0.1);
  if (dice.coin()) row.offset = dice.uniform(-0.1, 0.1);
  if (dice.coin()) row.scale = dice.uniform(0.9, 1.1);
  row.q_min = dice.uniform(-3, 0);
  row.q_max = dice.uniform(0.2, 3);
  return row;
}

JointMechanics random_mechanics(Dice& dice) {
  JointMechanics m;
  m.parallel_next = dice.coin();
  if (dice.coin()) m.gear_ratio = dice.uniform(1, 200);
  if (dice.coin()) m.stiffness_Nm_per_rad = dice.uniform(1e4, 1e6);
  if (dice.coin()) m.link_mass_kg = dice.uniform(1, 200);
  if (dice.coin()) m.link_com_m = dice.vector(1.0);
  if (dice.coin()) m.length_m = dice.uniform(0.1, 2);
  if (dice.coin()) m.EI_Nm2 = dice.uniform(1, 1e6);
  if (dice.coin()) m.GJ_Nm2 = dice.uniform(1, 1e6);
  if (dice.coin()) m.kg_per_m = dice.uniform(1, 100);
  return m;
}

HeldOutRule random_rule(Dice& dice, const std::filesystem::path& folder) {
  using Kind = HeldOutRule::Kind;
  switch (dice.below(5)) {
    case 0:
      return {.kind = Kind::kShare, .share = dice.uniform(0.01, 0.99)};
    case 1:
      return {.kind = Kind::kFolds, .folds = 2 + dice.below(50)};
    case 2:
      return {.kind = Kind::kColumn};
    case 3:
      return {.kind = Kind::kFile, .file = folder / "other" / "verify.csv"};
    default:
      return {};
  }
}

/// Wide enough for any joint; the numbers of a layout are compared in tests/drivers/wire.
drivers::BusLayout random_bus(Dice& dice, const Cell& cell) {
  const auto arm = drivers::bus_arm(cell.nominal, cell.deploy.cycle_s);
  auto out = drivers::arm_layout(arm, dice.below(4), drivers::CorrectionForm::kPose);
  out.can_format = drivers::CanFrame::Format::kFd;
  if (dice.coin()) out.byte_order = drivers::ByteOrder::kBig;
  return out;
}

Cell random_cell(Dice& dice, const std::filesystem::path& folder) {
  const char* const lengths[] = {"mm", "m", "um", "in"};
  const char* const angles[] = {"deg", "rad", "mrad"};
  Cell c;
  c.directory = folder;
  c.name = "cell \"4\" \\ \xC3\xA4\t#";
  c.serial = "S\x01\x7F\n";
  c.tolerance_m = dice.uniform(1e-5, 1e-3);
  c.robot_name = "arm";
  c.length_unit = lengths[dice.below(4)];
  c.angle_unit = angles[dice.below(3)];
  c.nominal.convention =
      dice.coin() ? format::Convention::kStandard : format::Convention::kModified;
  c.nominal.base = dice.pose();
  c.nominal.tool = dice.pose();
  for (int i = 1 + dice.below(9); i > 0; --i) {
    c.nominal.joints.push_back(random_joint(dice, i));
    c.mechanics.push_back(random_mechanics(dice));
  }
  c.gravity = dice.vector(9.81);
  if (dice.coin()) c.payload = {dice.uniform(0, 100), dice.vector(0.3)};
  c.measurement.files = {folder / "a b.csv", folder.parent_path() / "c.csv"};
  c.measurement.fit_frame = dice.coin();
  if (!c.measurement.fit_frame) c.measurement.X_MB = dice.pose();
  c.measurement.fit_target = dice.coin();
  if (!c.measurement.fit_target) c.measurement.target_T = dice.vector(0.3);
  if (dice.coin()) c.measurement.sigma_m = dice.uniform(1e-6, 1e-4);
  if (dice.coin()) c.measurement.sigma_rad = dice.uniform(1e-6, 1e-4);
  c.measurement.held_out = random_rule(dice, folder);
  c.measurement.seed = static_cast<std::uint64_t>(dice.below(1 << 30));
  if (dice.coin()) c.effects.push_back({"geometry", {}, {}, {}});
  if (dice.coin())
    c.effects.push_back(
        {"local_tree", {}, {{"min_gain", 0.02}, {"form", "crisp"}, {"degree", 2.0}}, {}});
  if (dice.coin())
    c.effects.push_back({"step", {0}, {{"after_row", 84.0}, {"of", std::string("joint")}}, {}});
  c.fit.model = dice.coin() ? FitSettings::Model::kDh : FitSettings::Model::kComplete;
  if (dice.coin()) c.fit.fixed = {c.nominal.joints[0].name + ".d", "frame.x"};
  if (dice.coin()) c.fit.prior_m = dice.uniform(0.0, 2e-3);
  if (dice.coin()) c.fit.prior_rad = dice.coin() ? 0.0 : dice.uniform(1e-5, 2e-3);
  if (dice.coin()) c.fit.priors = {{c.nominal.joints[0].name + ".a", dice.uniform(1e-5, 1e-3)}};
  c.deploy.cycle_s = dice.uniform(4e-3, 1e-2);
  c.deploy.max_correction_m = dice.uniform(1e-3, 1e-2);
  if (dice.coin()) c.deploy.link = drivers::BusUse::kModbus;
  if (dice.coin()) c.deploy.interface = "vcan1";
  if (dice.coin()) c.deploy.address = "192.168.0.7";
  if (dice.coin()) c.deploy.bus = std::make_shared<const drivers::BusLayout>(random_bus(dice, c));
  return c;
}

void expect_near(double a, double b) { EXPECT_NEAR(a, b, 1e-15 * std::max(1.0, std::abs(b))); }

void expect_same(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  for (int k = 0; k < 3; ++k) expect_near(a[k], b[k]);
}

void expect_same(const format::Pose& a, const format::Pose& b) {
  expect_same(a.p, b.p);
  for (int k = 0; k < 4; ++k) expect_near(a.q[k], b.q[k]);
}

void expect_same(const std::optional<double>& a, const std::optional<double>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (a) expect_near(*a, *b);
}

void expect_same(const Cell& a, const Cell& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.serial, b.serial);
  EXPECT_EQ(a.robot_name, b.robot_name);
  EXPECT_EQ(a.length_unit + a.angle_unit, b.length_unit + b.angle_unit);
  expect_near(a.tolerance_m, b.tolerance_m);
  EXPECT_EQ(a.nominal.convention, b.nominal.convention);
  expect_same(a.nominal.base, b.nominal.base);
  expect_same(a.nominal.tool, b.nominal.tool);
  ASSERT_EQ(a.joints(), b.joints());
  for (int i = 0; i < a.joints(); ++i) {
    const auto &r = a.nominal.joints[i], &s = b.nominal.joints[i];
    EXPECT_EQ(r.name, s.name);
    EXPECT_EQ(r.type, s.type);
    for (const auto member :
         {&format::JointRow::alpha, &format::JointRow::a, &format::JointRow::d,
          &format::JointRow::theta, &format::JointRow::beta, &format::JointRow::scale,
          &format::JointRow::offset, &format::JointRow::q_min, &format::JointRow::q_max})
      expect_near(r.*member, s.*member);
    const auto &m = a.mechanics[i], &n = b.mechanics[i];
    EXPECT_EQ(m.parallel_next, n.parallel_next);
    for (const auto member :
         {&JointMechanics::gear_ratio, &JointMechanics::stiffness_Nm_per_rad,
          &JointMechanics::link_mass_kg, &JointMechanics::length_m, &JointMechanics::EI_Nm2,
          &JointMechanics::GJ_Nm2, &JointMechanics::kg_per_m})
      expect_same(m.*member, n.*member);
    ASSERT_EQ(m.link_com_m.has_value(), n.link_com_m.has_value());
    if (m.link_com_m) expect_same(*m.link_com_m, *n.link_com_m);
  }
  expect_same(a.gravity, b.gravity);
  expect_near(a.payload.mass_kg, b.payload.mass_kg);
  expect_same(a.payload.com_m, b.payload.com_m);
  EXPECT_EQ(a.measurement.files, b.measurement.files);
  EXPECT_EQ(a.measurement.fit_frame, b.measurement.fit_frame);
  expect_same(a.measurement.X_MB, b.measurement.X_MB);
  EXPECT_EQ(a.measurement.fit_target, b.measurement.fit_target);
  expect_same(a.measurement.target_T, b.measurement.target_T);
  expect_same(a.measurement.sigma_m, b.measurement.sigma_m);
  expect_same(a.measurement.sigma_rad, b.measurement.sigma_rad);
  EXPECT_EQ(a.measurement.held_out.kind, b.measurement.held_out.kind);
  expect_near(a.measurement.held_out.share, b.measurement.held_out.share);
  EXPECT_EQ(a.measurement.held_out.folds, b.measurement.held_out.folds);
  EXPECT_EQ(a.measurement.held_out.file, b.measurement.held_out.file);
  EXPECT_EQ(a.measurement.seed, b.measurement.seed);
  ASSERT_EQ(a.effects.size(), b.effects.size());
  for (std::size_t i = 0; i < a.effects.size(); ++i) {
    EXPECT_EQ(a.effects[i].name, b.effects[i].name);
    EXPECT_EQ(a.effects[i].joints, b.effects[i].joints);
    EXPECT_EQ(a.effects[i].options, b.effects[i].options);
  }
  EXPECT_EQ(a.fit.model, b.fit.model);
  EXPECT_EQ(a.fit.fixed, b.fit.fixed);
  expect_near(a.fit.prior_m, b.fit.prior_m);
  expect_near(a.fit.prior_rad, b.fit.prior_rad);
  ASSERT_EQ(a.fit.priors.size(), b.fit.priors.size());
  for (std::size_t i = 0; i < a.fit.priors.size(); ++i) {
    EXPECT_EQ(a.fit.priors[i].name, b.fit.priors[i].name);
    expect_near(a.fit.priors[i].sigma, b.fit.priors[i].sigma);
  }
  expect_near(a.deploy.cycle_s, b.deploy.cycle_s);
  expect_near(a.deploy.max_correction_m, b.deploy.max_correction_m);
  EXPECT_EQ(a.deploy.link, b.deploy.link);
  EXPECT_EQ(a.deploy.interface, b.deploy.interface);
  EXPECT_EQ(a.deploy.address, b.deploy.address);
  EXPECT_EQ(a.deploy.bus != nullptr, b.deploy.bus != nullptr);
}

TEST(RoundTrip, OfACellGivesTheSameCellAndThenTheSameText) {
  std::printf("%d cells, seed %u\n", kCells, kSeed);
  Dice dice(kSeed);
  const std::filesystem::path folder = "/cells/one", file = folder / "cell.toml";
  for (int i = 0; i < kCells; ++i) {
    const Cell cell = random_cell(dice, folder);
    const std::string text = write_cell(cell);
    Cell back;
    ASSERT_EQ(summary(problems_of([&] { back = parse_cell(text, file); })), Summary{}) << text;
    expect_same(cell, back);
    const Cell again = parse_cell(write_cell(back), file);
    EXPECT_EQ(again.nominal.joints, back.nominal.joints) << "bit by bit: it came from a file";
    if (HasFailure()) FAIL() << "cell " << i << "\n" << text;
  }
}

Measurements random_measurements(Dice& dice, const std::vector<bool>& is_angle) {
  const int n = 1 + dice.below(30);
  Measurements m;
  const auto rows3 = [&](double low, double high) {
    Rows3 out(n, 3);
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < 3; ++k) out(i, k) = dice.uniform(low, high);
    return out;
  };
  m.q.resize(n, static_cast<Eigen::Index>(is_angle.size()));
  for (int i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < m.q.cols(); ++k) m.q(i, k) = dice.uniform(-3, 3);
  m.p_M = rows3(-3, 3);
  if (dice.coin()) m.sigma_m = rows3(1e-6, 1e-4);
  if (dice.coin()) m.nominal_B = rows3(-3, 3);
  m.has_axis = {true, dice.coin(), dice.coin()};
  if (dice.coin()) m.quat_M.resize(n, 4);
  for (int i = 0; i < n; ++i) {
    m.pose.push_back(dice.coin() ? "P, \"" + std::to_string(i) + "\"" : "#" + std::to_string(i));
    m.set.push_back(static_cast<SetMark>(dice.below(4)));
    const auto q = dice.pose().q;
    if (m.has_orientation()) m.quat_M.row(i) << q[0], q[1], q[2], q[3];
  }
  return m;
}

void expect_same_axes(const Rows3& a, const Rows3& b, const std::array<bool, 3>& has_axis,
                      double tolerance) {
  ASSERT_EQ(a.rows(), b.rows());
  for (int i = 0; i < a.rows(); ++i)
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(a(i, k), has_axis[k] ? b(i, k) : 0.0, tolerance);
}

TEST(RoundTrip, OfMeasurementsGivesTheSameNumbers) {
  std::printf("%d files, seed %u\n", kCells, kSeed);
  Dice dice(kSeed);
  const Folder folder;
  const std::vector<bool> is_angle{true, false, true, true};
  for (int f = 0; f < kCells; ++f) {
    const Measurements m = random_measurements(dice, is_angle);
    Column temperature{"temp_K", "temp", "K", Quantity::kTemperature, {}, {}};
    Column note{"note", "note", "", Quantity::kText, {}, {}};
    for (int i = 0; i < m.size(); ++i) {
      temperature.values.push_back(dice.uniform(15, 35));
      note.text.push_back("a;b, \"c\" ");
    }
    const auto text =
        write_measurements(m, is_angle, {{"robot", "two\nlines"}}, {temperature, note});
    const auto back =
        read_measurements({folder.put("m.csv", text)}, is_angle, Needs::kJointsAndPosition);
    ASSERT_EQ(back.size(), m.size());
    EXPECT_EQ(back.pose, m.pose);
    EXPECT_EQ(back.set, m.set);
    EXPECT_LT((back.q - m.q).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_EQ(back.has_axis, m.has_axis);
    ASSERT_EQ(back.quat_M.rows(), m.quat_M.rows());
    expect_same_axes(back.p_M, m.p_M, m.has_axis, 1e-15);
    expect_same_axes(back.sigma_m, m.sigma_m, m.has_axis, 1e-19);
    expect_same_axes(back.nominal_B, m.nominal_B, m.has_axis, 1e-15);
    for (int i = 0; i < m.quat_M.rows(); ++i)
      EXPECT_LT((back.quat_M.row(i) - m.quat_M.row(i)).cwiseAbs().maxCoeff(), 1e-15);
    const auto& table = back.tables.at(0);
    EXPECT_EQ(table.find("note")->text, note.text);
    EXPECT_EQ(table.comments.at(0), std::pair(std::string("robot"), std::string("two lines")));
    for (int i = 0; i < m.size(); ++i)
      EXPECT_NEAR(table.find("temp")->values[i], temperature.values[i], 1e-13);
  }
}

}  // namespace
}  // namespace plumb::offline
