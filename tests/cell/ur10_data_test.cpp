// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "cell/cell.hpp"
#include "cell/measurement_reader.hpp"
#include "cell/measurements.hpp"
#include "support.hpp"

namespace plumb::offline {
namespace {

namespace fs = std::filesystem;

class Ur10 : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(data_ / "cell.toml")) GTEST_SKIP() << "no UR10 data beside the project";
  }
  const fs::path data_ = PLUMB_SHARED_DATA;
  const std::vector<bool> arm_ = std::vector<bool>(6, true);
};

TEST_F(Ur10, CellIsReadWithoutARemark) {
  const Cell cell = read_cell(data_ / "cell.toml");
  EXPECT_EQ(cell.joints(), 6);
  EXPECT_EQ(cell.nominal.joints[1].a, -0.612);
  EXPECT_TRUE(cell.remarks.empty());
}

TEST_F(Ur10, SeriesHaveTheRowsTheirReadmeSays) {
  const auto a = read_measurements({data_ / "series_A.csv"}, arm_, Needs::kJointsAndPosition);
  EXPECT_EQ(a.size(), 11911);
  EXPECT_EQ(a.pose[0], "A00000");
  EXPECT_EQ(a.p_M(0, 0), 2.3619831);
  EXPECT_EQ(a.q(0, 0), -1.5708);
  EXPECT_EQ(a.tables[0].find("temp")->values[0], 23.6800003);
  const auto b = read_measurements({data_ / "series_B.csv"}, arm_, Needs::kJointsAndPosition);
  EXPECT_EQ(b.size(), 1495);
  EXPECT_EQ(b.sigma_m.rows(), 1495);
  EXPECT_NEAR(b.sigma_m(0, 0), 31.674e-6, 1e-15);
  EXPECT_TRUE(b.has_orientation());
}

TEST_F(Ur10, SeriesWrittenAndReadAgainAreTheSameBits) {
  const Folder folder;
  const auto b = read_measurements({data_ / "series_B.csv"}, arm_, Needs::kJointsAndPosition);
  const auto text = write_measurements(b, arm_, {}, {});
  const auto again =
      read_measurements({folder.put("b.csv", text)}, arm_, Needs::kJointsAndPosition);
  EXPECT_EQ(again.p_M, b.p_M);
  EXPECT_EQ(again.sigma_m, b.sigma_m);
  EXPECT_LT((again.q - b.q).cwiseAbs().maxCoeff(), 1e-15);
}

TEST_F(Ur10, RawFilesAreRefusedColumnByColumn) {
  const auto problems = problems_of([&] {
    read_measurements({data_ / "raw" / "series_A_grid.csv"}, arm_, Needs::kJointsAndPosition);
  });
  ASSERT_GE(problems.size(), 20u);
  EXPECT_TRUE(std::all_of(problems.begin(), problems.end(),
                          [](const Problem& p) { return p.code == "E-CSV-UNIT"; }));
}

}  // namespace
}  // namespace plumb::offline
