// SPDX-License-Identifier: Apache-2.0
#include "plan/expected_evidence.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>

#include "tests/random_numbers.hpp"

namespace plumb::offline {
namespace {

Eigen::MatrixXd random_matrix(tests::Random& random, Eigen::Index rows, Eigen::Index columns) {
  Eigen::MatrixXd out(rows, columns);
  for (double& x : out.reshaped()) x = random.uniform(-1.0, 1.0);
  return out;
}

/// Z less its least-squares fit by G, whose sizes have a prior of 1 sigma = 1; the prior is written
/// as further lines.
Eigen::MatrixXd cleared(const Eigen::MatrixXd& G, const Eigen::MatrixXd& Z) {
  const Eigen::Index p = G.cols(), lines = G.rows();
  Eigen::MatrixXd A(lines + p, p), B = Eigen::MatrixXd::Zero(lines + p, Z.cols());
  A << G, Eigen::MatrixXd::Identity(p, p);
  B.topRows(lines) = Z;
  return B - A * A.colPivHouseholderQr().solve(B);
}

TEST(ExpectedEvidence, AddedReadingsGiveTheProductsOfTheWholeFit) {
  tests::Random random(1);
  const Eigen::MatrixXd G = random_matrix(random, 60, 7), Z = random_matrix(random, 60, 5);
  ClearedProducts some(G.topRows(30), Z.topRows(30));
  for (int i = 30; i < 57; i += 3) some.add(G.middleRows(i, 3), Z.middleRows(i, 3));
  const Eigen::MatrixXd last = some.with(G.bottomRows(3), Z.bottomRows(3));
  const Eigen::MatrixXd whole = cleared(G, Z);
  EXPECT_LT((last - whole.transpose() * whole).cwiseAbs().maxCoeff(), 1e-10);
  const Eigen::MatrixXd part = cleared(G.topRows(57), Z.topRows(57));
  EXPECT_LT((some.products() - part.transpose() * part).cwiseAbs().maxCoeff(), 1e-10);
}

/// Laws with one column each, that are alike in the first half of the readings and differ behind.
struct Two {
  Rivals rivals;
  Eigen::MatrixXd G, Z;
};
Two two_laws(tests::Random& random, Eigen::Index readings, double size) {
  Two out;
  const Eigen::Index lines = 3 * readings, half = lines / 2;
  out.G = random_matrix(random, lines, 4);
  out.Z = random_matrix(random, lines, 4);
  out.Z.col(1).head(half) = out.Z.col(0).head(half);
  out.Z.col(2) = size * out.Z.col(0);
  out.Z.col(3) = size * out.Z.col(1);
  out.rivals.a = {{{0, 1, 1.0}}, 2};
  out.rivals.b = {{{1, 1, 1.0}}, 3};
  out.rivals.scale = {.variance = 1.0, .dof = 1e6, .lines = static_cast<double>(half)};
  return out;
}

std::vector<Eigen::MatrixXd> readings_of(const Eigen::MatrixXd& lines, Eigen::Index first) {
  std::vector<Eigen::MatrixXd> out;
  for (Eigen::Index i = first; i < lines.rows(); i += 3) out.emplace_back(lines.middleRows(i, 3));
  return out;
}

TEST(ExpectedEvidence, TheWrongLawIsBehindByHalfOfWhatItCannotImitate) {
  tests::Random random(2);
  const Two two = two_laws(random, 40, 3.0);
  ClearedProducts all(two.G.topRows(60), two.Z.topRows(60));
  EXPECT_NEAR(exact_leads(two.rivals, all.products(), 0.0).least(), 0.0, 1e-9);
  for (Eigen::Index i = 60; i < 120; i += 3)
    all.add(two.G.middleRows(i, 3), two.Z.middleRows(i, 3));
  // A's motion less its fit by geometry and B.
  Eigen::MatrixXd imitators(120, 5);
  imitators << two.G, two.Z.col(1);
  const double left = cleared(imitators, two.Z.col(2)).squaredNorm();
  const Leads leads = exact_leads(two.rivals, all.products(), 60.0);
  EXPECT_NEAR(leads.if_a, 0.5 * left, 0.05 * left + 1.0);
  EXPECT_GT(leads.if_b, 5.0);
}

TEST(ExpectedEvidence, ChoosesTheReadingsAtWhichTheLawsDiffer) {
  tests::Random random(3);
  const Two two = two_laws(random, 40, 3.0);
  const ClearedProducts known(two.G.topRows(30), two.Z.topRows(30));
  const auto G = readings_of(two.G, 30), Z = readings_of(two.Z, 30);
  const Choice choice = choose_readings(two.rivals, known, G, Z, 8);
  ASSERT_EQ(choice.chosen.size(), 8U);
  int alike = 0;
  for (const int i : choice.chosen) alike += i < 10 ? 1 : 0;  // the first half of the lines
  EXPECT_LE(alike, 1);
  EXPECT_EQ(choice.further, 24.0);
  // Better than readings at random.
  const double chosen = quick_leads(two.rivals, choice.products, 24.0).least();
  for (int trial = 0; trial < 50; ++trial) {
    ClearedProducts other = known;
    std::vector<int> left(G.size());
    for (std::size_t i = 0; i < left.size(); ++i) left[i] = static_cast<int>(i);
    for (int k = 0; k < 8; ++k) {
      const auto at = static_cast<std::size_t>(random.below(static_cast<int>(left.size())));
      other.add(G[static_cast<std::size_t>(left[at])], Z[static_cast<std::size_t>(left[at])]);
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
    }
    EXPECT_LE(quick_leads(two.rivals, other.products(), 24.0).least(), chosen + 0.1);
  }
}

TEST(ExpectedEvidence, HeldOutReadingsDoNotCount) {
  tests::Random random(4);
  Two two = two_laws(random, 20, 3.0);
  two.rivals.fit_share = 0.5;
  const ClearedProducts known(two.G.topRows(30), two.Z.topRows(30));
  EXPECT_EQ(
      choose_readings(two.rivals, known, readings_of(two.G, 30), readings_of(two.Z, 30), 4).further,
      6.0);
}

}  // namespace
}  // namespace plumb::offline
