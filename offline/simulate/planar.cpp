// SPDX-License-Identifier: Apache-2.0
#include "simulate/planar.hpp"

#include <cmath>
#include <numbers>

#include "simulate/arm_rows.hpp"
#include "simulate/law_list.hpp"

namespace plumb::offline {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kGravity = 9.81;      // [m/s^2]
constexpr double kSteel_Pa = 210e9;    // Young's modulus
constexpr double kSteel_kg_m3 = 7850;  // density
constexpr double kLoad_kg = 10.0;      // at point C

double bar_diameter_m(PlanarVariant variant) {
  return variant == PlanarVariant::kPublished ? 0.1 : 0.06;
}

double weight_N_per_m(PlanarVariant variant) {
  const double d = bar_diameter_m(variant);
  return kSteel_kg_m3 * kGravity * kPi * d * d / 4.0;
}

std::vector<double> colon_range(double low, double step, double high) {
  std::vector<double> out;
  const int count = static_cast<int>((high - low) / step) + 1;
  for (int k = 0; k < count; ++k) out.push_back(low + k * step);
  return out;
}

}  // namespace

Eigen::Vector2d planar_deflection(PlanarVariant variant, double phi12, double phi23) {
  const double L = kPlanarLink_m, d = bar_diameter_m(variant);
  const double P = kLoad_kg * kGravity;
  const double q = weight_N_per_m(variant);
  const double EI = kSteel_Pa * kPi * d * d * d * d / 64.0;
  const double p2 = phi12, p3 = phi12 + phi23;
  const double c2 = std::cos(p2);
  const double cc = std::cos(variant == PlanarVariant::kPublished ? phi23 : p3);
  const double F = (P + q * L) * (variant == PlanarVariant::kPublished ? cc : c2);
  const double M = (P * L + q * L * L / 2.0) * cc;
  const double L2 = L * L, L3 = L2 * L, L4 = L3 * L;
  const double w3 = (P * L3 / 3.0 + q * L4 / 8.0) * cc / EI;
  const double w2 = (F * L3 / 3.0 + q * L4 * c2 / 8.0 + M * L2 / 2.0) / EI;
  const double theta2 = (F * L2 / 2.0 + q * L3 * c2 / 6.0 + M * L) / EI;
  return {w2 * std::sin(p2) + (w3 + theta2 * L) * std::sin(p3),
          -w2 * std::cos(p2) - (w3 + theta2 * L) * std::cos(p3)};
}

RowsN planar_grid(double step) {
  const auto phi12 = colon_range(-kPi / 2.0, step, kPi / 2.0);
  const auto phi23 = colon_range(-0.75 * kPi, step, 0.75 * kPi);
  RowsN q(static_cast<Eigen::Index>(phi12.size() * phi23.size()), 2);
  Eigen::Index row = 0;
  for (const double a : phi12) {
    for (const double b : phi23) q.row(row++) << a, b;
  }
  return q;
}

Cell planar_cell(PlanarVariant variant) {
  const bool published = variant == PlanarVariant::kPublished;
  const double link_mm = 1e3 * kPlanarLink_m;
  Cell cell =
      sim::cell_from_sheet(format::Convention::kStandard,
                           {{.a_mm = link_mm, .q_min = -90, .q_max = 90, .parallel_next = true},
                            {.a_mm = link_mm, .q_min = -135, .q_max = 135}},
                           0.0);
  cell.name = published ? "Planar arm, published figures" : "Planar arm, printed dimensions";
  cell.serial = published ? "PLANAR-PUBLISHED" : "PLANAR-PRINTED";
  cell.robot_name = "Planar two-link arm";
  cell.gravity = {0.0, -kGravity, 0.0};
  cell.payload = {kLoad_kg, {0.0, 0.0, 0.0}};
  for (auto& link : cell.mechanics) {
    link.length_m = kPlanarLink_m;
    link.kg_per_m = weight_N_per_m(variant) / kGravity;
  }
  cell.measurement.fit_frame = false;
  cell.measurement.X_MB.p = {0.0, kPlanarOriginY_m, 0.0};
  cell.measurement.fit_target = false;
  return cell;
}

namespace sim {
namespace {

class PlanarBeams : public Law {
 public:
  explicit PlanarBeams(PlanarVariant variant) : variant_(variant) {}

  void bend(const Moment& now, Deflection& out) const override {
    const VectorXd& q = now.visit.q;
    out.tip_B.head<2>() += planar_deflection(variant_, q(0), q(1));
  }

  nlohmann::ordered_json truth() const override {
    return {{"bar_diameter_mm", bar_diameter_m(variant_) * 1e3},
            {"E_GPa", kSteel_Pa * 1e-9},
            {"density_kg_per_m3", kSteel_kg_m3},
            {"load_kg", kLoad_kg},
            {"link_3_loads_turn_with",
             variant_ == PlanarVariant::kPublished ? "phi23" : "phi12 + phi23"}};
  }
  std::vector<std::string> inputs() const override { return {"q1", "q2"}; }

 private:
  PlanarVariant variant_;
};

bool is_planar_arm(const format::Chain& chain) {
  if (chain.convention != format::Convention::kStandard || chain.joints.size() != 2) return false;
  for (const auto& row : chain.joints) {
    if (row.type != format::JointType::kRevolute || row.a != kPlanarLink_m) return false;
    if (row.alpha != 0.0 || row.d != 0.0 || row.theta != 0.0 || row.beta != 0.0) return false;
  }
  return chain.base == format::Pose{} && chain.tool == format::Pose{};
}

std::unique_ptr<Law> make_planar(PlanarVariant variant, const HiddenEffect& effect,
                                 const World& world) {
  if (!is_planar_arm(world.cell.nominal)) {
    throw Failure(Exit::kUsage, {Severity::kError, "E-SIM-JOINT",
                                 effect.name + " is only for the planar arm of the study",
                                 std::nullopt, "plumb demo planar-printed writes such a cell"});
  }
  return std::make_unique<PlanarBeams>(variant);
}

}  // namespace

std::unique_ptr<Law> make_planar_published(const HiddenEffect& effect, const World& world) {
  return make_planar(PlanarVariant::kPublished, effect, world);
}

std::unique_ptr<Law> make_planar_printed(const HiddenEffect& effect, const World& world) {
  return make_planar(PlanarVariant::kPrinted, effect, world);
}

}  // namespace sim
}  // namespace plumb::offline
