// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <sys/resource.h>
#include <Eigen/QR>

#include <ctime>

#include "simulate/planar.hpp"
#include "tests/tree/tree_data.hpp"
#include "tests/yardstick.hpp"
#include "tree/blended_path.hpp"
#include "tree/growth.hpp"
#include "tree/stop_rules.hpp"

/// The printed figures of the published study, with the trees of this trainer.
namespace plumb::offline {
namespace {

using namespace tree_data;

constexpr int kInputs = 2;

/// Length and lateral offset of both links: X = L2 c2 + v2 s2 + L3 c3 + v3 s3, Y likewise.
Eigen::MatrixXd link_columns(const RowsN& q) {
  Eigen::MatrixXd A(2 * q.rows(), 4);
  for (Eigen::Index i = 0; i < q.rows(); ++i) {
    const double p2 = q(i, 0), p3 = q(i, 0) + q(i, 1);
    A.row(2 * i) << std::cos(p2), std::cos(p3), std::sin(p2), std::sin(p3);
    A.row(2 * i + 1) << std::sin(p2), std::sin(p3), -std::cos(p2), -std::cos(p3);
  }
  return A;
}

Eigen::VectorXd deflections(const RowsN& q) {
  Eigen::VectorXd out(2 * q.rows());
  for (Eigen::Index i = 0; i < q.rows(); ++i)
    out.segment<2>(2 * i) = planar_deflection(PlanarVariant::kPublished, q(i, 0), q(i, 1));
  return out;
}

/// Inputs normalised to the training grid, and what is to be learnt in mm, shape (n, 2).
struct Data {
  Samples u, y;
};

Samples normalised_to(const RowsN& box, const RowsN& q) {
  Samples u(q.rows(), q.cols());
  for (Eigen::Index k = 0; k < q.cols(); ++k) {
    const double low = box.col(k).minCoeff(), high = box.col(k).maxCoeff();
    u.col(k) = (2.0 * q.col(k).array() - low - high) / (high - low);
  }
  return u;
}

Samples by_axis(const Eigen::VectorXd& stacked) {
  Samples out(stacked.size() / 2, 2);
  for (Eigen::Index i = 0; i < out.rows(); ++i) out.row(i) << stacked[2 * i], stacked[2 * i + 1];
  return out;
}

struct Study {
  Eigen::Vector4d links_mm;  // change of L2, L3, then v2, v3
  Data train, test;
};

Study calibrated_arm() {
  const RowsN train = planar_grid(0.1), test = planar_grid(0.05);
  Study out;
  const Eigen::VectorXd d = 1e3 * deflections(train);
  out.links_mm = link_columns(train).colPivHouseholderQr().solve(d);
  out.train = {normalised_to(train, train), by_axis(d - link_columns(train) * out.links_mm)};
  out.test = {normalised_to(train, test),
              by_axis(1e3 * deflections(test) - link_columns(test) * out.links_mm)};
  return out;
}

/// The position itself, nothing known of the arm.
Data positions(const RowsN& box, const RowsN& q) {
  return {normalised_to(box, q),
          by_axis(1e3 * (deflections(q) + link_columns(q) * Eigen::Vector4d(1, 1, 0, 0)))};
}

/// As published: the leaves are not clamped.
double linear_prediction(const GrownTree& tree, const Splits& stand, const Samples& u,
                         Eigen::Index i) {
  int at = 0;
  while (tree.cells[at].is_split() && stand[at])
    at = u(i, tree.cells[at].input) <= tree.cells[at].threshold ? tree.cells[at].low
                                                                : tree.cells[at].high;
  const TreeCell* c = &tree.cells[at];
  return c->model.w[0] + c->model.w[1] * u(i, 0) + c->model.w[2] * u(i, 1);
}

struct Errors {
  double mean = 0.0, max = 0.0;  // [mm]
};

Errors errors(const GrownTree& x, const Splits& in_x, const GrownTree& y, const Splits& in_y,
              const Data& test) {
  Errors out;
  for (Eigen::Index i = 0; i < test.u.rows(); ++i) {
    const double e = std::hypot(test.y(i, 0) - linear_prediction(x, in_x, test.u, i),
                                test.y(i, 1) - linear_prediction(y, in_y, test.u, i));
    out.mean += e / static_cast<double>(test.u.rows());
    out.max = std::max(out.max, e);
  }
  std::cout << x.leaf_cells(in_x).size() << " + " << y.leaf_cells(in_y).size()
            << " leaves: " << out.mean << " / " << out.max << " mm\n";
  return out;
}

GrownTree grown(const Data& data, int axis, int min_samples) {
  return grow(data.u, data.y.col(axis), {.max_leaves = 4096, .min_samples = min_samples});
}

TEST(TreeStudy, TheCalibratedArmIsThePublishedOne) {
  const Study study = calibrated_arm();
  ASSERT_EQ(study.train.u.rows(), 1536);
  ASSERT_EQ(study.test.u.rows(), 5985);
  EXPECT_NEAR(study.links_mm[0], 0.0021, 1e-4);
  EXPECT_NEAR(study.links_mm[1], -0.0018, 1e-4);
  EXPECT_NEAR(study.links_mm[2], 0.4108, 1e-4);
  EXPECT_NEAR(study.links_mm[3], 0.3603, 1e-4);
  EXPECT_NEAR(study.test.y.rowwise().norm().mean(), 0.4467, 1e-4);
  EXPECT_NEAR(study.test.y.rowwise().norm().maxCoeff(), 0.7158, 1e-4);
}

TEST(TreeStudy, TheDeltaStopGivesThePublishedTrees) {
  const Study study = calibrated_arm();
  const GrownTree x = grown(study.train, 0, 10), y = grown(study.train, 1, 10);
  const Splits in_x = stop_by_delta(x, 0.035), in_y = stop_by_delta(y, 0.035);
  EXPECT_EQ(x.leaf_cells(in_x).size(), 90u);
  EXPECT_EQ(y.leaf_cells(in_y).size(), 75u);
  const Errors e = errors(x, in_x, y, in_y, study.test);
  EXPECT_NEAR(e.mean, 0.0141, 1e-4);
  EXPECT_NEAR(e.max, 0.134, 1e-3);
}

/// y: the gains at 81 to 84 leaves lie between 2.02 and 2.07 %, so its size hangs on a hair.
TEST(TreeStudy, StoppingBelowTwoPercentGivesThePublishedSizes) {
  const Study study = calibrated_arm();
  const GrownTree x = grown(study.train, 0, 10), y = grown(study.train, 1, 10);
  const int x_leaves = leaves_at_gain(x, 0.02), y_leaves = leaves_at_gain(y, 0.02);
  EXPECT_NEAR(x_leaves, 92, 3);
  EXPECT_NEAR(y_leaves, 81, 4);
  EXPECT_NEAR(leaves_at_gain(y, 0.0203), 81, 3);
  const Errors e = errors(x, x.first_splits(x_leaves), y, y.first_splits(y_leaves), study.test);
  EXPECT_LT(e.mean, 0.0134);
  EXPECT_NEAR(e.max, 0.071, 1e-3);
}

TEST(TreeStudy, ATreeAloneGrownOutHasThePublishedSizeAndError) {
  const RowsN train = planar_grid(0.1), test = planar_grid(0.05);
  const Data data = positions(train, train);
  const GrownTree x = grown(data, 0, 6), y = grown(data, 1, 6);
  EXPECT_EQ(x.leaves(), 211);
  EXPECT_EQ(y.leaves(), 210);
  const Errors e =
      errors(x, x.first_splits(x.leaves()), y, y.first_splits(y.leaves()), positions(train, test));
  EXPECT_NEAR(e.mean, 7.58, 0.1);
  EXPECT_NEAR(e.max, 49.4, 0.1);
}

TEST(TreeStudy, ATreeAloneOnAHundredAndFortyEightThousandPosesHasThePublishedSizeAndError) {
  const RowsN train = planar_grid(0.01), test = planar_grid(0.05);
  ASSERT_EQ(train.rows(), 148680);
  const Data data = positions(train, train);
  const GrownTree x = grown(data, 0, 31), y = grown(data, 1, 31);
  EXPECT_EQ(x.leaves(), 3224);
  EXPECT_EQ(y.leaves(), 3298);
  const Errors e =
      errors(x, x.first_splits(x.leaves()), y, y.first_splits(y.leaves()), positions(train, test));
  EXPECT_NEAR(e.mean, 0.431, 1e-3);
  EXPECT_NEAR(e.max, 2.17, 1e-2);
}

/// Least processor time of some tries [s]: other work on the machine only ever adds.
template <class Work>
double least_time(int tries, const Work& work) {
  double least = 1e9;
  for (int i = 0; i < tries; ++i) {
    const std::clock_t start = std::clock();
    work();
    least = std::min(least, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return least;
}

#if defined(NDEBUG) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

TEST(TreeStudy, NinetyThreeLeavesGrowInTwoMillisecondsAndThousandsInASixthOfASecond) {
  const Study study = calibrated_arm();
  const double small = least_time(10, [&] {
    grow(study.train.u, study.train.y.col(0), {.max_leaves = 93, .min_samples = 10});
  });
  const RowsN fine = planar_grid(0.01);
  const Data data = positions(fine, fine);
  const double large = least_time(8, [&] { grown(data, 0, 31); });
  std::cout << "93 leaves: " << 1e3 * small << " ms; 148680 poses, 3224 leaves: " << 1e3 * large
            << " ms\n";
  const double slower = tests::times_slower();
  EXPECT_LT(small, 2e-3 * slower);
  // Half as much again: what shares the memory of the machine also costs processor time.
  EXPECT_LT(large, 1.5 * 0.15 * slower);
}

TEST(TreeStudy, TheCostOfGrowingIsThatOfSorting) {
  double least = 1e9, most = 0.0;
  for (const double step : {0.05, 0.025, 0.01}) {
    const RowsN q = planar_grid(step);
    const Data data = positions(q, q);
    const double n = static_cast<double>(q.rows());
    const double share = least_time(3, [&] { grown(data, 0, 31); }) / (n * std::log2(n));
    least = std::min(least, share);
    most = std::max(most, share);
  }
  std::cout << "time / (n log2 n): " << 1e9 * least << " to " << 1e9 * most << " ns\n";
  EXPECT_LT(most, 2.0 * least);
}

TEST(TreeStudy, OneLeastSquaresOverThirtyThreeHundredLeavesTakesSeconds) {
  const RowsN fine = planar_grid(0.01);
  const Data data = positions(fine, fine);
  GrowthSettings growth = kBlendedGrowth;
  growth.max_leaves = 3300;
  const GrownTree tree = grow(data.u, data.y.col(0), growth);
  const format::Tree ramps = with_ramps(tree.cut(tree.leaves()), data.u, 1.0).value();
  const double seconds =
      least_time(1, [&] { BlendedFit(ramps, data.u).solve(data.y.col(0), kLeastRidge); });
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::cout << tree.leaves() << " leaves: " << seconds << " s, " << usage.ru_maxrss / 1024
            << " MB\n";
  EXPECT_LT(seconds, 10.0 * tests::times_slower());
  EXPECT_LT(usage.ru_maxrss, 4L << 20);  // kB
}

#endif

}  // namespace
}  // namespace plumb::offline
