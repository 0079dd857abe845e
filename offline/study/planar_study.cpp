// SPDX-License-Identifier: Apache-2.0
#include "study/planar_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "numbers/jobs.hpp"
#include "plumb/runtime/detail/tree.hpp"
#include "study/beam_formula.hpp"
#include "study/planar_physics.hpp"
#include "study/planar_remarks.hpp"
#include "study/textbook_trees.hpp"
#include "tree/blended_fit.hpp"
#include "tree/blended_path.hpp"
#include "tree/choice.hpp"
#include "tree/domain.hpp"
#include "tree/stop_rules.hpp"

namespace plumb::offline::study {
namespace {

constexpr double kMm = 1e-3;
constexpr int kDisjoint = 20000;  // random poses, none of them on a grid of the study
constexpr std::uint64_t kDisjointSeed = 5985;
constexpr double kDelta = 0.035, kGain = 0.02;  // stop criteria of the study
/// Least samples a leaf with which the printed sizes of the trees come out (planar_remarks.cpp),
/// and numbers of leaves of the trees beside them.
constexpr int kSamplesCalibrated = 10, kSamplesAlone = 6, kSamplesFine = 31;
constexpr int kAffineLeaves = 93, kQuadraticLeaves = 80, kAloneLeaves = 211;
constexpr int kFineAffine = 3300, kFineQuadratic = 1600;
constexpr double kFewNoise_m = 20e-6;      // noise of the few poses
constexpr double kTrackerNoise_m = 10e-6;  // smallest noise in a diagnosis

using Predictor = std::function<Samples(const RowsN&)>;

std::string leaf_count(const AxisTrees& trees) {
  return fmt::format("{} + {} leaves", trees.tree[0].leaves(), trees.tree[1].leaves());
}

/// Training data: joint angles, and the values that the trees of both axes shall have there.
struct Lesson {
  RowsN q;
  Samples y;
  format::Domain domain;
  Samples u;

  Lesson(RowsN angles, Samples target)
      : q(std::move(angles)),
        y(std::move(target)),
        domain(trained_box(q)),
        u(normalised(domain, q)) {}
};

/// The three sets of training data of the study.
struct Lessons {
  Lesson rest;                 // residuals of the calibrated links
  Lesson alone;                // the positions
  std::optional<Lesson> fine;  // the positions on the finest grid
};

Lessons lessons_of(const PlanarRequest& request, const PlanarPoses& train, const Links& links) {
  Lessons out{Lesson(train.q, train.p_AC_A - rigid_points(links, train.q)),
              Lesson(train.q, train.p_AC_A), std::nullopt};
  if (request.grids == PlanarRequest::Grids::kAll) {
    const PlanarPoses many =
        measured_poses(request.variant, planar_grid(kFineStep), request.noise_m, request.seed + 1);
    out.fine.emplace(many.q, many.p_AC_A);
  }
  return out;
}

using Grown = std::array<GrownTree, 2>;

Grown grown(const Lesson& lesson, const GrowthSettings& settings) {
  Grown out;
  run_jobs(2, [&](int axis) { out[axis] = grow(lesson.u, lesson.y.col(axis), settings); });
  return out;
}

template <class Rule>
AxisTrees cut(const Lesson& lesson, const Grown& trees, const Rule& rule) {
  AxisTrees out{lesson.domain, {}};
  for (int axis = 0; axis < 2; ++axis) out.tree[axis] = unheld(trees[axis].cut(rule(trees[axis])));
  return out;
}

Splits all_splits(const GrownTree& tree) { return tree.first_splits(tree.leaves()); }
Splits by_gain(const GrownTree& tree) { return tree.first_splits(leaves_at_gain(tree, kGain)); }
Splits by_delta(const GrownTree& tree) { return stop_by_delta(tree, kDelta); }

/// Blended trees with the size and ridge that `plumb fit` would choose.
AxisTrees chosen(const Lesson& lesson, int leaves, int degree, std::uint64_t seed) {
  Samples y = Samples::Zero(lesson.q.rows(), format::kTreeAxes);
  y.leftCols<2>() = lesson.y;
  std::vector<int> group(lesson.q.rows());
  std::iota(group.begin(), group.end(), 0);
  const TreeSettings settings{.seed = seed,
                              .form = TreeForm::kBlended,
                              .sharing = Sharing::kOwn,
                              .max_leaves = leaves,
                              .max_degree = degree,
                              .min_samples = 3 * degree + 3};
  const TreeChoice choice = choose_trees(lesson.q, y, {true, true, false}, group, settings);
  return {choice.domain, {choice.trees[0], choice.trees[1]}};
}

/// Blended trees of this size, fitted by one global least squares without a choice by
/// cross-validation.
AxisTrees at_once(const Lesson& lesson, int leaves, int degree) {
  AxisTrees out{lesson.domain, {}};
  GrowthSettings growth = kBlendedGrowth;
  growth.max_leaves = leaves;
  growth.degree = degree;
  growth.min_samples = 20 * degree;
  for (int axis = 0; axis < 2; ++axis) {
    const Samples y = lesson.y.col(axis);
    const GrownTree tree = grow(lesson.u, y, growth);
    const auto ramps = with_ramps(tree.cut(tree.leaves()), lesson.u, 1.0);
    if (ramps) out.tree[axis] = BlendedFit(*ramps, lesson.u).solve(y, kLeastRidge)[0];
  }
  return out;
}

/// Collects the rows of the table. Every error is relative to positions without noise.
class Collector {
 public:
  Collector(PlanarStudy& out, const RowsN& training_q)
      : out_(out),
        test_(true_poses(out.request.variant, planar_grid(kTestStep))),
        disjoint_(
            true_poses(out.request.variant, random_angles(training_q, kDisjoint, kDisjointSeed))) {
    out.test_q = test_.q;
  }

  void add(StudyRow row, const Predictor& predict) {
    out_.request.tell(row.model);
    const Samples at_test = predict(test_.q);
    row.test = total_error(at_test, test_.p_AC_A);
    row.disjoint = total_error(predict(disjoint_.q), disjoint_.p_AC_A);
    row.error_at_test = (at_test - test_.p_AC_A).rowwise().norm();
    out_.rows.push_back(std::move(row));
  }

  /// Adds a row for trees on top of rigid links, or for trees alone (base = nullptr).
  void add_trees(StudyRow row, const AxisTrees& trees, const Links* base) {
    row.size = leaf_count(trees);
    row.trees = trees;
    add(std::move(row), [&](const RowsN& q) {
      return base == nullptr ? values(trees, q)
                             : Samples(rigid_points(*base, q) + values(trees, q));
    });
  }

 private:
  PlanarStudy& out_;
  PlanarPoses test_, disjoint_;
};

std::optional<TotalError> printed(double mean_mm, double max_mm) {
  return TotalError{mean_mm * kMm, max_mm * kMm};
}

void add_textbook(const Lesson& lesson, const Grown& trees, const Links& links, Collector& rows) {
  AxisTrees ramps{lesson.domain, {}};
  AxisTrees kept = ramps, local = ramps;
  std::array<Splits, 2> stand;
  for (int axis = 0; axis < 2; ++axis) {
    stand[axis] = trees[axis].first_splits(std::min(kAffineLeaves, trees[axis].leaves()));
    ramps.tree[axis] = with_ramps(trees[axis].cut(stand[axis]), lesson.u, 1.0).value();
    kept.tree[axis] = unheld(ramps.tree[axis]);
    const Samples y = lesson.y.col(axis);
    local.tree[axis] = unheld(BlendedFit(ramps.tree[axis], lesson.u).solve_locally(y)[0]);
  }
  const auto row = [](const char* key, const char* model) {
    return StudyRow{.key = key, .model = model, .size = {}, .kind = RowKind::kComparison};
  };
  rows.add_trees(row("smoothed_kept", "greedy tree smoothed, coefficients kept"), kept, &links);
  rows.add_trees(row("smoothed_local", "greedy tree smoothed, leaves fitted one by one"), local,
                 &links);
  StudyRow m5 = row("m5", "greedy tree with M5 smoothing");
  m5.size = leaf_count(kept);
  rows.add(m5, [&](const RowsN& q) {
    const Samples u = normalised(lesson.domain, q);
    Samples y = rigid_points(links, q);
    for (int axis = 0; axis < 2; ++axis) y.col(axis) += m5_smoothed(trees[axis], stand[axis], u);
    return y;
  });
  StudyRow textbook = row("lolimot", "textbook LOLIMOT, Gaussian validity");
  textbook.size = leaf_count(kept);
  rows.add(textbook, [&](const RowsN& q) {
    const Samples u = normalised(lesson.domain, q);
    Samples y = rigid_points(links, q);
    for (int axis = 0; axis < 2; ++axis)
      y.col(axis) += lolimot(lesson.u, lesson.y.col(axis), kAffineLeaves, u);
    return y;
  });
}

void add_published(const Lessons& lessons, const Links& links, Collector& rows) {
  const Lesson &rest = lessons.rest, &alone = lessons.alone;
  rows.add({.key = "rigid",
            .model = "rigid kinematic model",
            .size = "-",
            .paper = printed(0.643, 1.427)},
           [](const RowsN& q) { return rigid_points(kNominalLinks, q); });
  rows.add({.key = "calibrated",
            .model = "calibrated rigid model",
            .size = "4 numbers",
            .paper = printed(0.447, 0.716)},
           [&](const RowsN& q) { return rigid_points(links, q); });
  const Grown calibrated =
      grown(rest, {.max_leaves = format::kMaxTreeLeaves, .min_samples = kSamplesCalibrated});
  rows.add_trees({.key = "calibrated_llmt",
                  .model = "calibrated + LLMT, delta stop",
                  .size = {},
                  .paper = printed(0.0157, 0.131)},
                 cut(rest, calibrated, by_delta), &links);
  rows.add_trees({.key = "calibrated_llmt_gain",
                  .model = "calibrated + LLMT, 2 % stop",
                  .size = {},
                  .paper = printed(0.0157, 0.131)},
                 cut(rest, calibrated, by_gain), &links);
  rows.add_trees(
      {.key = "alone",
       .model = "tree alone, 1536 positions",
       .size = {},
       .paper = printed(7.877, 42.815)},
      cut(alone, grown(alone, {.max_leaves = format::kMaxTreeLeaves, .min_samples = kSamplesAlone}),
          all_splits),
      nullptr);
  if (lessons.fine) {
    const Lesson& fine = *lessons.fine;
    rows.add_trees(
        {.key = "alone_fine",
         .model = "tree alone, 148,680 positions",
         .size = {},
         .paper = printed(0.406, 3.299)},
        cut(fine, grown(fine, {.max_leaves = format::kMaxTreeLeaves, .min_samples = kSamplesFine}),
            all_splits),
        nullptr);
  }
  add_textbook(rest, calibrated, links, rows);
}

void add_ours(const Lessons& lessons, const Links& links, std::uint64_t seed, Collector& rows) {
  const auto row = [](const char* key, const char* model) {
    return StudyRow{.key = key, .model = model, .size = {}, .kind = RowKind::kOurs};
  };
  rows.add_trees(row("blended_affine", "calibrated + blended tree, affine leaves"),
                 chosen(lessons.rest, kAffineLeaves, 1, seed), &links);
  rows.add_trees(row("blended_quadratic", "calibrated + blended tree, quadratic leaves"),
                 chosen(lessons.rest, kQuadraticLeaves, 2, seed), &links);
  rows.add_trees(row("blended_alone", "blended tree alone, 1536 positions"),
                 chosen(lessons.alone, kAloneLeaves, 2, seed), nullptr);
  if (!lessons.fine) return;
  rows.add_trees(row("blended_alone_fine_affine", "blended tree alone, 148,680 positions, affine"),
                 at_once(*lessons.fine, kFineAffine, 1), nullptr);
  rows.add_trees(
      row("blended_alone_fine_quadratic", "blended tree alone, 148,680 positions, quadratic"),
      at_once(*lessons.fine, kFineQuadratic, 2), nullptr);
}

void add_physics(const PlanarRequest& request, const PlanarPoses& train, PlanarStudy& out,
                 Collector& rows) {
  const auto row = [](std::string key, std::string model, std::string size) {
    return StudyRow{.key = std::move(key),
                    .model = std::move(model),
                    .size = std::move(size),
                    .kind = RowKind::kPhysics};
  };
  const BeamFormula beams = fit_beams(train);
  rows.add(row("beam_formula", "correct beam formula, 1/EI free", "5 numbers"),
           [&](const RowsN& q) { return points(beams, q); });
  const PlanarCell planar =
      measured_cell({request.variant, train.q, request.noise_m, request.seed});
  const ArmState flexure = with_link_flexure(planar);
  rows.add(row("link_flexure", "plumb: link_flexure of both links", "6 numbers"),
           [&](const RowsN& q) { return points(flexure, q); });
  request.tell("diagnosing");
  const PlanarDiagnosis found = diagnosed(measured_cell(
      {request.variant, train.q, std::max(request.noise_m, kTrackerNoise_m), request.seed}));
  out.diagnosis = found.verdict;
  rows.add(row("diagnosed", "plumb diagnose --apply", found.added),
           [&](const RowsN& q) { return points(found.state, q); });
  for (int n : {20, 45}) {
    const PlanarCell few = measured_cell(
        {request.variant, random_angles(train.q, n, request.seed), kFewNoise_m, request.seed});
    const ArmState state = with_link_flexure(few);
    rows.add(row(fmt::format("link_flexure_{}", n),
                 fmt::format("the same from {} poses with 20 um noise", n), "6 numbers"),
             [&](const RowsN& q) { return points(state, q); });
  }
}

}  // namespace

PlanarStudy run_planar_study(const PlanarRequest& request) {
  PlanarStudy out{
      .request = request, .links = {}, .test_q = {}, .rows = {}, .diagnosis = {}, .remarks = {}};
  const PlanarPoses train =
      measured_poses(request.variant, planar_grid(kTrainingStep), request.noise_m, request.seed);
  out.links = calibrate_links(train);
  const Lessons lessons = lessons_of(request, train, out.links.d);
  Collector rows(out, train.q);
  add_published(lessons, out.links.d, rows);
  add_ours(lessons, out.links.d, request.seed, rows);
  add_physics(request, train, out, rows);
  out.remarks = planar_remarks(request.variant, out.rows);
  return out;
}

}  // namespace plumb::offline::study
