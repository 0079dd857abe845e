// SPDX-License-Identifier: Apache-2.0
#include "simulate/session.hpp"

#include <cmath>
#include <optional>

namespace plumb::offline::sim {
namespace {

constexpr double kTrial = 1e-4;        // [rad] or [m]
constexpr double kHardlySeen = 1e-6;   // smallest share that geometry does not absorb
constexpr double kSmallest_m = 1e-12;  // smallest motion of a trial
constexpr double kAgreement = 1e-4;    // relative agreement of a size with the requested one
constexpr int kMostRounds = 6;

// The shift of every measured point that one law alone causes [m].
Rows3 shift_M(const World& world, const Law& law) {
  Rows3 out(static_cast<Eigen::Index>(world.visits.size()), 3);
  for (int row = 0; row < out.rows(); ++row) {
    const Visit& visit = world.visits[static_cast<std::size_t>(row)];
    const VectorXd q = world.joints(visit);
    const Frames rigid = world.arm.frames(q);
    const Loads loads(world.masses, rigid, visit.payload.mass_kg,
                      Vector3d(visit.payload.com_m.data()));
    Deflection deflection(world.arm.joints());
    law.bend({row, visit, rigid, loads}, deflection);
    deflection.dq = world.masses.drives.to_joints(deflection.dq);
    const Vector3d bent = world.arm.frames(q, deflection).tool * world.X_TG.translation();
    const Vector3d straight = rigid.tool * world.X_TG.translation();
    out.row(row) = (world.X_MB.linear() * (bent + deflection.tip_B - straight)).transpose();
  }
  return out;
}

[[noreturn]] void refuse_size(const std::string& message, const std::string& help) {
  throw Failure(Exit::kUsage, {Severity::kError, "E-SIM-SIZE", message, std::nullopt, help});
}

/// Finds the size of an effect at which the requested amount is visible. Laws are proportional to
/// their size to first order.
class Sizer {
 public:
  Sizer(const World& world, const SimulationPlan& plan)
      : world_(world), plan_(plan), visible_(world, plan.axes) {}

  EffectSize size_of(const Law& law) const { return visible_.size_of(shift_M(world_, law)); }

  double find(HiddenEffect effect) const {
    const LawEntry& entry = *find_law(effect.name);
    const double wanted = *effect.size_sigma * plan_.noise_m;
    if (plan_.noise_m <= 0.0)
      refuse_size("a size in sigma needs noise", "give a size in urad or um");
    double size = kTrial;
    for (int round = 0; round < kMostRounds; ++round) {
      effect.size = size;
      const EffectSize now = size_of(*entry.make(effect, world_));
      if (now.visible_m < kSmallest_m || now.visible_m < kHardlySeen * now.rms_m) {
        refuse_size(effect.name + " cannot be seen here: geometry explains all of it",
                    "name another joint, vary what it depends on, or give its size in urad or um");
      }
      if (std::abs(now.visible_m / wanted - 1.0) < kAgreement) return size;
      size *= wanted / now.visible_m;
    }
    return size;
  }

 private:
  const World& world_;
  const SimulationPlan& plan_;
  Visible visible_;
};

}  // namespace

Isometry3d bent_pose(const World& world, const std::vector<HiddenLaw>& laws, int row) {
  const Visit& visit = world.visits[static_cast<std::size_t>(row)];
  const VectorXd q = world.joints(visit);
  const Frames rigid = world.arm.frames(q);
  const Loads loads(world.masses, rigid, visit.payload.mass_kg,
                    Vector3d(visit.payload.com_m.data()));
  Deflection deflection(world.arm.joints());
  for (const auto& hidden : laws) hidden.law->bend({row, visit, rigid, loads}, deflection);
  if (world.scatter.rows() > 0) deflection.dq += world.scatter.row(row).transpose();
  deflection.dq = world.masses.drives.to_joints(deflection.dq);
  Isometry3d X_BG = world.arm.frames(q, deflection).tool * world.X_TG;
  X_BG.translation() += deflection.tip_B;
  return world.X_MB * X_BG;
}

SizedLaws make_laws(const std::vector<HiddenEffect>& effects, const World& world,
                    const SimulationPlan& plan) {
  SizedLaws out;
  if (effects.empty()) return out;
  const Sizer sizer(world, plan);
  for (HiddenEffect effect : effects) {
    if (effect.size_sigma) effect.size = sizer.find(effect);
    effect.size_sigma.reset();
    auto law = find_law(effect.name)->make(effect, world);
    law->pin(effect);
    out.sizes.push_back(sizer.size_of(*law));
    out.laws.push_back({effect.name, std::move(law)});
    out.effects.push_back(std::move(effect));
  }
  return out;
}

}  // namespace plumb::offline::sim
