// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>

#include "cell/measurements.hpp"
#include "cell/table_file.hpp"
#include "import/importer.hpp"
#include "tests/import/imported_text.hpp"

namespace plumb::offline {
namespace {

const std::filesystem::path kData = PLUMB_SHARED_DATA;

ImportWishes wishes() {
  ImportWishes out;
  const char* joints[] = {"shoulder_pan_joint", "shoulder_lift_joint", "elbow_joint",
                          "wrist_1_joint",      "wrist_2_joint",       "wrist_3_joint"};
  for (int j = 0; j < 6; ++j)
    out.map.push_back(std::string(joints[j]) + "=q" + std::to_string(j + 1) + "_rad");
  for (const char* axis : {"x", "y", "z"}) {
    const std::string a = axis;
    out.map.push_back("Goal " + a + "=n" + a + "_m");
    out.map.push_back("measurement_" + a + "=" + a + "_mm");
    out.map.push_back("measurement_r" + a + "=r" + a + "_deg");
  }
  out.map.push_back("measurement_temperature=temp_degC");
  out.rotation = "xyz-moving";
  return out;
}

void expect_equal(const Table& got, const Table& canonical, const std::string& name) {
  const Column *a = got.find(name), *b = canonical.find(name);
  ASSERT_NE(a, nullptr) << name;
  ASSERT_NE(b, nullptr) << name;
  ASSERT_EQ(a->values.size(), b->values.size());
  for (std::size_t i = 0; i < a->values.size(); ++i)
    ASSERT_NEAR(a->values[i], b->values[i], 1e-9) << name << ", row " << i;
}

TEST(Ur10Import, TheNightOnTheGridEqualsItsCanonicalFile) {
  if (!std::filesystem::exists(kData)) GTEST_SKIP() << "no " << kData;
  const Table got = tests::table_of(import_file(kData / "raw/series_A_grid.csv", wishes()));
  const Table canonical = read_table(kData / "series_A.csv");
  ASSERT_EQ(got.rows(), 11911);
  for (const char* name :
       {"q1", "q2", "q3", "q4", "q5", "q6", "x", "y", "z", "qw", "qx", "qy", "qz", "t"})
    expect_equal(got, canonical, name);
  EXPECT_NEAR(got.find("nx")->values[0], 0.365141, 1e-12);
}

TEST(Ur10Import, TheJointConfigurationsToo_AndTheirRuinedTimeStampsAreReported) {
  if (!std::filesystem::exists(kData)) GTEST_SKIP() << "no " << kData;
  ImportWishes with_sigma = wishes();
  for (const char* axis : {"x", "y", "z"})
    with_sigma.map.push_back("measurement_std_" + std::string(axis) + "=s" + axis + "_mm");
  const Imported data = import_file(kData / "raw/series_B_joint_configurations.csv", with_sigma);
  const Table got = tests::table_of(data);
  const Table canonical = read_table(kData / "series_B.csv");
  for (const char* name : {"q1", "q6", "x", "y", "z", "qw", "qx", "qy", "qz", "sx", "sy", "sz"})
    expect_equal(got, canonical, name);
  EXPECT_EQ(got.find("t"), nullptr);
  const bool told = std::any_of(data.remarks.begin(), data.remarks.end(),
                                [](const Problem& p) { return p.code == "W-IMPORT-TIME"; });
  EXPECT_TRUE(told);
}

}  // namespace
}  // namespace plumb::offline
