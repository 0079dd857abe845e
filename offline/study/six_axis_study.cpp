// SPDX-License-Identifier: Apache-2.0
#include "study/six_axis_study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

#include "arm/predicted_points.hpp"
#include "diagnose/diagnosis.hpp"
#include "fit/calibrate.hpp"
#include "plumb/runtime/detail/tree.hpp"
#include "simulate/arm_rows.hpp"
#include "simulate/simulate.hpp"
#include "simulate/study_arms.hpp"
#include "study/textbook_trees.hpp"
#include "study/white_noise.hpp"
#include "tree/choice.hpp"
#include "tree/domain.hpp"
#include "tree/growth.hpp"

namespace plumb::offline::study {
namespace {

constexpr int kFresh = 2000;          // poses that nothing was fitted to
constexpr int kLeaves = 5;            // of a tree at most
constexpr double kNoise_m = 10e-6;    // of the tracker
constexpr double kMoving_kg = 400.0;  // mass of the moving links
const std::vector<std::string> kHidden{"joint_compliance:J2=42urad,J3=42urad",
                                       "gear_harmonics:J1=30urad"};

std::vector<int> numbered(int n) {
  std::vector<int> out(n);
  std::iota(out.begin(), out.end(), 0);
  return out;
}

double mean_norm(const Samples& e) { return e.rowwise().norm().mean(); }

Simulation measured(const Cell& cell, int poses, double noise_m, std::uint64_t arm,
                    std::uint64_t seed) {
  SimulationPlan plan;
  plan.poses = poses;
  plan.noise_m = noise_m;
  plan.seed = seed;
  plan.truth.effects = kHidden;
  plan.truth.seed = arm;
  return simulate(cell, plan);
}

/// Three trees with five leaves each over all joints, as published: without held-out poses, and
/// without clamping.
class PublishedTrees {
 public:
  PublishedTrees(const RowsN& q, const Samples& e) : domain_(trained_box(q)) {
    const Samples u = normalised(domain_, q);
    const int fewest = static_cast<int>(q.cols()) + 1;
    for (int axis = 0; axis < 3; ++axis) {
      const GrownTree tree = grow(u, e.col(axis), {.max_leaves = kLeaves, .min_samples = fewest});
      trees_.push_back(unheld(tree.cut(tree.leaves())));
    }
  }

  Samples values(const RowsN& q) const {
    const Samples u = normalised(domain_, q);
    Samples out(q.rows(), 3);
    for (Eigen::Index i = 0; i < q.rows(); ++i)
      for (int axis = 0; axis < 3; ++axis)
        out(i, axis) =
            TreeView(trees_[axis], static_cast<int>(q.cols())).evaluate(SampleRow(u, i).span());
    return out;
  }

 private:
  format::Domain domain_;
  std::vector<format::Tree> trees_;
};

/// White noise with the same mean norm as `like`. Shape (n, 3).
Samples noise_like(const Samples& like, std::uint64_t seed) {
  Random random(seed);
  Samples out(like.rows(), 3);
  for (Eigen::Index i = 0; i < out.rows(); ++i)
    for (Eigen::Index k = 0; k < 3; ++k) out(i, k) = normal(random);
  return out * (mean_norm(like) / mean_norm(out));
}

std::string words_for(const Diagnosis& found) {
  std::vector<std::string> out;
  for (const auto& step : found.added) {
    std::vector<std::string> joints;
    for (int j : step.entry.joints) joints.push_back(fmt::format("J{}", j + 1));
    out.push_back(fmt::format("{} {}", step.entry.name, fmt::join(joints, ",")));
  }
  return out.empty() ? "nothing" : fmt::format("{}", fmt::join(out, "; "));
}

/// The calibration with all effects that the diagnosis supports. The diagnosis has not seen the
/// truth.
ArmState diagnosed(const Cell& cell, const MeasurementFiles& seen, SixAxisDraw& out) {
  const Diagnosis found = diagnose(cell, seen, {.apply = true, .tell = {}});
  out.added = words_for(found);
  Cell with = cell;
  with.effects = found.effects;
  return calibrate(with, seen, numbered(seen.size())).state;
}

SixAxisDraw one_draw(const SixAxisRequest& request, std::uint64_t seed) {
  const Cell cell = six_axis_cell();
  const Simulation seen = measured(cell, request.poses, kNoise_m, seed, 2 * seed);
  const Simulation fresh = measured(cell, kFresh, 0.0, seed, 2 * seed + 1);
  SixAxisDraw out;
  const ArmState nominal = place_nominal(cell, seen.measured, numbered(request.poses));
  const Samples e = residuals(seen.measured, predict_points(nominal, seen.measured));
  const Samples e_fresh = fresh.true_p_M - predict_points(nominal, fresh.measured);
  const PublishedTrees trees(seen.measured.q, e);
  out.before = mean_norm(e);
  out.published_seen = mean_norm(e - trees.values(seen.measured.q));
  out.before_fresh = mean_norm(e_fresh);
  out.published_fresh = mean_norm(e_fresh - trees.values(fresh.measured.q));
  const Samples noise = noise_like(e, seed);
  const PublishedTrees of_noise(seen.measured.q, noise);
  out.noise_seen = mean_norm(noise - of_noise.values(seen.measured.q));
  out.noise_fresh = mean_norm(of_noise.values(fresh.measured.q));
  const ArmState ours = diagnosed(cell, seen.measured, out);
  out.ours_fresh = mean_norm(fresh.true_p_M - predict_points(ours, fresh.measured));
  out.tree = choose_trees(seen.measured.q, e, {true, true, true}, seen.measured.replicate_group,
                          TreeSettings{})
                 .reason;
  return out;
}

std::vector<double> sorted(const SixAxisStudy& study, double SixAxisDraw::*figure) {
  std::vector<double> out;
  for (const auto& draw : study.draws) out.push_back(draw.*figure);
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace

Cell six_axis_cell() {
  Cell cell = sim::cell_from_sheet(format::Convention::kModified,
                                   {{0, 0, 642, 0, -180, 180},
                                    {.alpha_deg = -89.9955,
                                     .a_mm = 249.2886,
                                     .d_mm = 450.9658,
                                     .theta_deg = -90.0587,
                                     .q_min = -115,
                                     .q_max = 120,
                                     .parallel_next = true},
                                    {0.0192, 950.007, -450, 89.9319, -140, 145},
                                    {90.0423, 0.6907, 800.94, 0.0045, -180, 180},
                                    {-90.0598, -0.3995, 0, -0.0045, -120, 120},
                                    {90, 0, 194, 0, -180, 180}},
                                   150);
  cell.name = "Six-axis study";
  cell.serial = "STUDY-SIX-AXIS";
  cell.robot_name = "TX200-like arm, Table 2 and an assumed sixth axis";
  cell.payload = {20.0, {0.0, 0.0, 0.1}};
  sim::state_masses(cell, kMoving_kg);
  return cell;
}

SixAxisStudy run_six_axis_study(const SixAxisRequest& request) {
  SixAxisStudy out{request, {}};
  for (int i = 0; i < request.draws; ++i) {
    request.tell(fmt::format("arm {} of {}", i + 1, request.draws));
    out.draws.push_back(one_draw(request, request.seed + static_cast<std::uint64_t>(i)));
  }
  return out;
}

double median_of(const SixAxisStudy& study, double SixAxisDraw::*figure) {
  const auto x = sorted(study, figure);
  return 0.5 * (x[(x.size() - 1) / 2] + x[x.size() / 2]);
}

double worst_of(const SixAxisStudy& study, double SixAxisDraw::*figure) {
  return sorted(study, figure).back();
}

}  // namespace plumb::offline::study
