// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdio>
#include <limits>

#include "plumb/runtime/corrector.hpp"
#include "tests/runtime/true_arm.hpp"

namespace plumb {
namespace {

using test::Joints;

constexpr std::uint64_t kSeed = 20240607;
constexpr int kTargets = 20;  // a model
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

/// The refusals of the design, judged at q by singular values, determinants and distances.
class Judge {
 public:
  Judge(const test::ArmKind& kind, const format::GuardLimits& limits)
      : kind_(kind), limits_(limits), controller_(kind.nominal) {}

  /// What is due if q is the solution. `margin`: how near to a limit the answer is either.
  Status due(const Joints& q, const Joints& seed, bool& margin) const {
    const double s = limits_.min_singular_value;
    const Eigen::MatrixXd J = jacobian(q);
    const double pose = singular_value(J, kind_.pose_rank);
    const double position = singular_value(J.topRows(3), kind_.position_rank);
    double far = 0.0;
    for (std::size_t i = 0; i < q.size(); ++i) {
      const bool slides = kind_.nominal.joints[i].type == format::JointType::kPrismatic;
      far = std::max(far, std::abs(q[i] - seed[i]) / (slides ? limits_.length_scale_m : 1.0));
    }
    margin = std::abs(pose - s) < 1e-9 || std::abs(position - s) < 1e-9 ||
             std::abs(far - limits_.max_seed_distance) < 1e-9;
    if (pose < s || position < s) return Status::kNearSingular;
    if (q.size() == 6 && J.determinant() * jacobian(seed).determinant() < 0.0)
      return Status::kOtherConfiguration;
    return far > limits_.max_seed_distance ? Status::kFarFromSeed : Status::kOk;
  }

 private:
  Eigen::MatrixXd jacobian(const Joints& q) const {
    return controller_.scaled_jacobian(q, kind_.nominal, limits_.length_scale_m);
  }
  static double singular_value(const Eigen::MatrixXd& J, int rank) {
    return Eigen::JacobiSVD<Eigen::MatrixXd>(J).singularValues()(rank - 1);
  }

  test::ArmKind kind_;
  format::GuardLimits limits_;
  test::NominalController controller_;
};

struct Tally {
  int targets = 0, margin = 0;
  int refused_as_due = 0, accepted = 0;
  int elsewhere = 0;          // not the solution we made the target from
  int refused_undue = 0;      // refused though that solution deserves an answer
  int wrong_at_solution = 0;  // seeded with the solution itself: no way to miss it
  int wrongly_accepted = 0;   // by the judge, at the solution that was returned
  int astray = 0;             // refused on the way back from it to a correction in part
  int partial = 0;            // near a singular pose, of which positions are corrected in part
  int wrong_in_part = 0;      // more is left than there was, or a joint is far from its seed
};

void tally(const test::ArmKind& kind, const format::Model& model, test::RandomArm& random,
           Tally& out) {
  const Corrector corrector(model);
  const test::TrueArm arm(model);
  const Judge judge(kind, model.guard);
  const std::size_t n = model.nominal.joints.size();
  for (int k = 0; k < kTargets; ++k) {
    const Joints wanted = random.positions(model.nominal);
    Joints seed = wanted;
    const bool at_solution = random.coin();
    if (!at_solution)
      for (auto& x : seed) x += random.uniform(-0.3, 0.3) * random.uniform(0.0, 1.0);
    Transformd X_BD = arm.pose(wanted);
    if (model.guard.corrects == format::Corrects::kPosition)
      X_BD.R = test::NominalController(model.nominal).pose(wanted).R;
    const auto correction = corrector.solve(X_BD, seed, SeedKind::kCommanded);
    out.targets += !at_solution;

    bool margin = false;
    const Status due = judge.due(wanted, seed, margin);
    if (correction.status == Status::kPartial) {
      const Joints found(correction.q.begin(), correction.q.begin() + static_cast<long>(n));
      const Vector3 without =
          arm.pose(seed).p - test::NominalController(model.nominal).pose(seed).p;
      bool near_limit = false;
      ++out.partial;
      out.wrong_in_part += (arm.pose(found).p - X_BD.p).norm() > without.norm() + 1e-6 ||
                           (judge.due(found, seed, near_limit) != Status::kOk && !near_limit);
    } else if (margin) {
      ++out.margin;
    } else if (at_solution) {
      const bool in_part = n == 6 && model.guard.corrects == format::Corrects::kPosition;
      const bool astray = in_part && refused(correction.status) && correction.status != due;
      out.astray += astray;
      out.wrong_at_solution += correction.status != due && !astray;
    } else if (!refused(correction.status)) {
      const Joints found(correction.q.begin(), correction.q.begin() + static_cast<long>(n));
      bool near_limit = false;
      const Status verdict = judge.due(found, seed, near_limit);
      const bool missed = n >= 6 && (arm.pose(found).p - X_BD.p).norm() > 1e-9;
      out.wrongly_accepted += missed || (!near_limit && refused(verdict));
      out.accepted += due == Status::kOk;
      out.elsewhere += refused(due);
    } else if (refused(due)) {
      ++(correction.status == due ? out.refused_as_due : out.elsewhere);
    } else {
      ++out.refused_undue;
    }
  }
}

TEST(CorrectorRefusals, AreThoseOfTheDesignAndNoMore) {
  constexpr int kModels = 850;
  const auto kinds = test::arm_kinds();
  std::printf("count %zu seed %llu\n", kModels * kTargets * kinds.size(),
              static_cast<unsigned long long>(kSeed));
  test::RandomArm random(kSeed);
  for (const auto& kind : kinds) {
    Tally out;
    for (int k = 0; k < kModels; ++k) {
      auto model = test::random_model(random, kind.nominal);
      model.trees = {};
      model.guard.length_scale_m = random.coin() ? 1.0 : 0.7;
      tally(kind, model, random, out);
    }
    std::printf(
        "%-11s accepted %5d, refused as due %4d, undue %2d, elsewhere %3d, at a limit %d, "
        "in part %d, wrong %d %d %d\n",
        kind.name, out.accepted, out.refused_as_due, out.refused_undue, out.elsewhere, out.margin,
        out.partial, out.wrongly_accepted, out.wrong_at_solution, out.wrong_in_part);
    EXPECT_EQ(out.wrong_in_part, 0) << kind.name;
    EXPECT_EQ(out.wrongly_accepted, 0) << kind.name;
    EXPECT_EQ(out.wrong_at_solution, 0) << kind.name;
    EXPECT_GT(out.refused_as_due, 400) << kind.name;
    if (kind.nominal.joints.size() > 6) continue;  // the nearest solution is not the one we know
    // From far seeds near a singularity the steps can end in the neighbouring solution.
    EXPECT_LT(out.astray, out.targets / 200) << kind.name;
    EXPECT_LT(out.refused_undue, out.targets / 300) << kind.name;
    EXPECT_LT(out.elsewhere, out.targets / 80) << kind.name;
    EXPECT_LT(out.margin, 10) << kind.name;
  }
}

/// Refused: the target itself and the seed come back.
void expect_refused(const Correction& correction, Status status, const Transformd& X_BD,
                    const Joints& seed) {
  EXPECT_EQ(correction.status, status);
  EXPECT_EQ(correction.X_BC.p, X_BD.p);
  EXPECT_EQ(correction.X_BC.R, X_BD.R);
  for (std::size_t i = 0; i < seed.size(); ++i) EXPECT_EQ(correction.q[i], seed[i]);
}

format::Model model_of(const format::Chain& nominal) {
  test::RandomArm random(kSeed);
  format::Model model;
  model.nominal = nominal;
  model.calibrated = random.as_built(nominal);
  return model;
}

const Joints kPose6{0.3, -1.2, 1.4, -0.5, 1.0, 0.2};

TEST(CorrectorRefusals, AnInputThatIsNoNumberOrNoPoseGivesFiniteOutput) {
  const Corrector corrector(model_of(test::ur10()));
  const Transformd good = corrector.forward_model().predict(kPose6).X_BT;
  for (const double bad : {kNaN, kInf, -kInf, 2.0}) {
    Transformd X_BD = good;
    X_BD.R(1, 1) = bad;
    expect_refused(corrector.solve(X_BD, kPose6, SeedKind::kMeasured), Status::kNotFinite, {},
                   kPose6);
  }
  Transformd X_BD = good;
  X_BD.p(2) = kNaN;
  expect_refused(corrector.solve(X_BD, kPose6, SeedKind::kMeasured), Status::kNotFinite, {},
                 kPose6);
  for (const double bad : {kNaN, kInf, 1e5, -1e308}) {
    Joints seed = kPose6;
    seed[3] = bad;
    expect_refused(corrector.solve(good, seed, SeedKind::kMeasured), Status::kNotFinite, good,
                   Joints(6, 0.0));
  }
  expect_refused(corrector.solve(good, Joints(5, 0.1), SeedKind::kMeasured), Status::kNotFinite,
                 good, {});
}

TEST(CorrectorRefusals, MoreThanSixJointsNeedTheCommandedSeed) {
  const Corrector corrector(model_of(test::iiwa()));
  const Joints seed{0.3, -0.8, 0.4, 1.1, 0.5, 0.9, 0.2};
  const Transformd X_BD = corrector.forward_model().predict(seed).X_BT;
  for (const auto kind : {SeedKind::kMeasured, SeedKind::kLastSolution})
    expect_refused(corrector.solve(X_BD, seed, kind), Status::kSeedNotCommanded, X_BD, seed);
  EXPECT_EQ(corrector.solve(X_BD, seed, SeedKind::kCommanded).status, Status::kOk);
}

TEST(CorrectorRefusals, ATargetOutOfReachIsNeverAnsweredAndNeverBlowsUp) {
  const Corrector corrector(model_of(test::ur10()));
  for (const double x : {2.0, 100.0, 1e9, 1e300, 1.7e308}) {
    Transformd X_BD;
    X_BD.p(0) = x;
    const auto correction = corrector.solve(X_BD, kPose6, SeedKind::kMeasured);
    EXPECT_TRUE(refused(correction.status));
    EXPECT_EQ(correction.X_BC.p, X_BD.p);
    EXPECT_TRUE(std::isfinite(correction.residual_m) && std::isfinite(correction.residual_rad));
  }
}

/// There the sine of the angle is nothing, and no step turns the tool.
TEST(CorrectorRefusals, AToolHalfATurnFromItsTargetIsNotOnIt) {
  auto model = model_of(test::ur10());
  model.guard.corrects = format::Corrects::kPose;
  model.guard.max_seed_distance = 10.0;
  const Corrector corrector(model);
  for (int axis = 0; axis < 3; ++axis) {
    Transformd X_BD = corrector.forward_model().predict(kPose6).X_BT;
    for (int j = 0; j < 3; ++j)
      if (j != axis) X_BD.R.col(j) *= -1.0;
    const auto correction = corrector.solve(X_BD, kPose6, SeedKind::kMeasured);
    EXPECT_TRUE(refused(correction.status)) << static_cast<int>(correction.status);
    EXPECT_GT(correction.residual_rad, 0.1);
  }
}

TEST(CorrectorRefusals, AStretchedArmOfTwoJointsIsSingularThoughItCanStillTurn) {
  const Corrector corrector(model_of(test::planar(2)));
  const Joints stretched{0.4, 0.0};
  Transformd X_BD = corrector.forward_model().predict(stretched).X_BT;
  X_BD.p *= 1.002;
  const auto correction = corrector.solve(X_BD, stretched, SeedKind::kMeasured);
  EXPECT_TRUE(refused(correction.status)) << static_cast<int>(correction.status);
}

TEST(CorrectorRefusals, AnEmptyCorrectorHasNoModel) {
  EXPECT_EQ(Corrector().solve({}, kPose6, SeedKind::kMeasured).status, Status::kNoModel);
}

}  // namespace
}  // namespace plumb
