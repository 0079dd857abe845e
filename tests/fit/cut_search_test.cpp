// SPDX-License-Identifier: Apache-2.0
#include "noise/cut_search.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "noise/moving_part.hpp"
#include "noise/running_sums.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::offline {
namespace {

constexpr int kVisits = 40;

struct Line {
  Eigen::MatrixXd X, U;
  Eigen::VectorXd y;

  explicit Line(tests::Random& random) : X(3 * kVisits, 3), U(3 * kVisits, 5), y(3 * kVisits) {
    for (double* at : {X.data(), U.data(), y.data()}) {
      const auto size = at == X.data() ? X.size() : at == U.data() ? U.size() : y.size();
      for (Eigen::Index i = 0; i < size; ++i) at[i] = random.uniform(-1.0, 1.0);
    }
  }
};

/// What the visits behind the cut explain of the residual, by dense least squares.
double explained_behind(const Line& line, int cut) {
  const Eigen::MatrixXd X = line.X.bottomRows(3 * (kVisits - cut));
  const Eigen::VectorXd y = line.y.tail(3 * (kVisits - cut));
  return (X * X.colPivHouseholderQr().solve(y)).squaredNorm();
}

TEST(CutSearch, FindsTheCutThatADenseFitOfEveryCutFindsBest) {
  const std::uint64_t seed = 7;
  const auto count = tests::scaled(50);
  std::printf("[ seed     ] %d, %d cases\n", static_cast<int>(seed), static_cast<int>(count));
  tests::Random random(seed);
  for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(count); ++i) {
    const Line line(random);
    RunningSums sums(3);
    const auto best = best_cut(
        kVisits, cuts_of({0, kVisits}, 5),
        [&](int visit) { sums.add(line.X.middleRows(3 * visit, 3), line.y.segment(3 * visit, 3)); },
        [&](int) -> std::optional<double> {
          return RunningSums::Numbers(sums.XX.llt().solve(sums.Xy)).dot(sums.Xy);
        });
    ASSERT_TRUE(best);
    int right = 0;
    double most = 0.0;
    for (int cut = 5; cut <= kVisits - 5; ++cut)
      if (const double here = explained_behind(line, cut); here > most) most = here, right = cut;
    EXPECT_EQ(best->cut, right);
    EXPECT_NEAR(best->score, most, 1e-9 * most);
  }
}

TEST(CutSearch, TheSumsBesideAModelAreThoseOfAllLinesTogether) {
  tests::Random random(3);
  const Line line(random);
  RunningSums sums(3, 5);
  const Eigen::MatrixXd Ut = line.U.transpose();
  for (int visit = 0; visit < kVisits; ++visit) {
    const auto X = line.X.middleRows(3 * visit, 3);
    sums.add(X, line.y.segment(3 * visit, 3));
    sums.add_model(0, Ut.topRows(2).middleCols(3 * visit, 3), X);
    sums.add_model(2, Ut.bottomRows(3).middleCols(3 * visit, 3), X);
  }
  EXPECT_LT((sums.XX - line.X.transpose() * line.X).norm(), 1e-12);
  EXPECT_LT((sums.Xy - line.X.transpose() * line.y).norm(), 1e-12);
  EXPECT_LT((sums.UX - line.U.transpose() * line.X).norm(), 1e-12);
}

TEST(CutSearch, TriesNoCutThatIsNotAllowedAndSaysSoIfNoneIs) {
  std::vector<int> passed, tried;
  const auto pass = [&](int visit) { passed.push_back(visit); };
  const auto best = best_cut(10, cuts_near(cuts_of({0, 10}, 3), 6, 1), pass,
                             [&](int cut) -> std::optional<double> {
                               tried.push_back(cut);
                               if (cut == 6) return std::nullopt;
                               return -cut;
                             });
  EXPECT_EQ(passed, (std::vector<int>{9, 8, 7, 6, 5}));
  EXPECT_EQ(tried, (std::vector<int>{7, 6, 5}));
  ASSERT_TRUE(best);
  EXPECT_EQ(best->cut, 5);
  EXPECT_FALSE(best_cut(
      5, cuts_of({0, 5}, 3), [](int) {}, [](int) -> std::optional<double> { return 1.0; }));
  EXPECT_EQ(cuts_of({0, 5}, 3).count(), 0);
}

TEST(CutSearch, MovesAreSearchedAgainUntilNoneChanges) {
  std::vector<int> cuts{1, 7}, searched;
  const auto towards_five = [&](int& cut) {
    searched.push_back(cut);
    const int before = cut;
    cut = cut < 5 ? cut + 2 : 5;
    return cut != before;
  };
  settle(cuts, 9, towards_five);
  EXPECT_EQ(cuts, (std::vector<int>{5, 5}));
  EXPECT_EQ(searched, (std::vector<int>{1, 7, 3, 5, 5, 5}));
  searched.clear();
  settle(cuts, 0, towards_five);
  EXPECT_TRUE(searched.empty());
}

TEST(CutSearch, VisitsOfOneMomentStayAsTheyStood) {
  std::vector<int> items{0, 1, 2, 3, 4};
  const std::vector<double> time{2.0, 1.0, 2.0, 0.0, 1.0};
  put_in_order(items, [&](int i) { return time[static_cast<std::size_t>(i)]; });
  EXPECT_EQ(items, (std::vector<int>{3, 1, 4, 0, 2}));
}

TEST(CutSearch, ToolAndBaseAreTriedBeforeTheJoints) {
  const auto parts = moving_parts(2);
  ASSERT_EQ(parts.size(), 4U);
  EXPECT_EQ(parts[0].source, MotionSource::kTool);
  EXPECT_EQ(parts[1].source, MotionSource::kBase);
  EXPECT_EQ(parts[3].joint, 1);
}

}  // namespace
}  // namespace plumb::offline
