// SPDX-License-Identifier: Apache-2.0
#include "cell/earlier_arm.hpp"

#include "support.hpp"

namespace plumb::offline {
namespace {

/// A run without check sums, as earlier versions wrote them: it can be edited here.
std::string run_of(const std::string& estimates, const std::string& covariance,
                   const std::string& more = "") {
  return "{\"schema\": \"run/1\", \"inputs\": [{\"file\": \"m.csv\", \"sha256\": \"abc\"}]," +
         more +
         " \"held_out\": {\"n\": 20, \"rms_m\": 3e-4}, \"fit\": {\"n\": 20, \"rms_m\": 1e-4}," +
         " \"calibration\": {\"target\": {\"p\": [0, 0, 0.1], \"q\": [1, 0, 0, 0]}, \"chain\": "
         "{\"modified\": false, \"joints\": []}, \"estimates\": [" +
         estimates + "], \"covariance\": [" + covariance + "]}}";
}

std::string estimate(const std::string& name, bool robot, const std::string& value) {
  return "{\"name\": \"" + name + "\", \"length\": true, \"robot\": " + (robot ? "true" : "false") +
         ", \"value\": " + value + ", \"nominal\": 0.5, \"std\": 1, \"unit\": \"\"}";
}

class EarlierArmFile : public testing::Test {
 protected:
  EarlierArmFile() { folder.put("predictions.csv", "pose\n"); }
  std::string refused(const std::string& text) {
    folder.put("run.json", text);
    const auto problems = problems_of([&] { earlier_arm(folder.path()); });
    return problems.empty() ? "" : problems.front().code;
  }
  Folder folder;
};

TEST_F(EarlierArmFile, GivesTheNumbersOfTheArmAloneWithTheirCovariance) {
  const std::string all = estimate("J1.a", true, "0.51") + "," + estimate("frame.x", false, "3") +
                          "," + estimate("J2.a", true, "0.52");
  folder.put("run.json", run_of(all, "1, 2, 9, 0.5, 4, 5"));
  const EarlierArm arm = earlier_arm(folder.path());
  ASSERT_EQ(arm.numbers.size(), 2U);
  EXPECT_EQ(arm.numbers[1].name, "J2.a");
  EXPECT_EQ(arm.numbers[1].value, 0.52);
  EXPECT_EQ(arm.covariance(0, 0), 1.0);
  EXPECT_EQ(arm.covariance(1, 0), 0.5);
  EXPECT_EQ(arm.covariance(1, 1), 5.0);
  EXPECT_EQ(arm.inputs, std::vector<std::string>{"abc"});
  EXPECT_NEAR(arm.left_m, 3e-4 / std::sqrt(3.0), 1e-12);  // of the held-out poses
}

TEST_F(EarlierArmFile, RemembersTheReadingsOfAllRunsBeforeIt) {
  folder.put("run.json",
             run_of(estimate("J1.a", true, "0.5"), "1",
                    "\"from\": {\"run\": \"x\", \"check_sum\": \"y\", \"inputs\": [\"def\"]},"));
  EXPECT_EQ(earlier_arm(folder.path()).inputs, (std::vector<std::string>{"abc", "def"}));
}

TEST_F(EarlierArmFile, OfAFolderOfACellIsItsLatestRun) {
  std::filesystem::create_directories(folder.path() / "arm/runs/0002");
  std::filesystem::create_directories(folder.path() / "arm/runs/0010");
  std::filesystem::create_directories(folder.path() / "arm/runs/.draft-1");
  std::filesystem::create_directories(folder.path() / "arm/runs/0099");  // without a run
  for (const char* run : {"0002", "0010"})
    folder.put(std::string("arm/runs/") + run + "/predictions.csv", "pose\n");
  folder.put("arm/runs/0002/run.json", run_of(estimate("J1.a", true, "0.5"), "1"));
  folder.put("arm/runs/0010/run.json", run_of(estimate("J1.a", true, "0.6"), "1"));
  EXPECT_EQ(earlier_arm(folder.path() / "arm").numbers[0].value, 0.6);
  EXPECT_EQ(earlier_arm(folder.path() / "arm/runs/0002").numbers[0].value, 0.5);
}

TEST_F(EarlierArmFile, ThatIsDamagedOrNoRunIsRefused) {
  EXPECT_EQ(refused(""), "E-CELL-EARLIER");
  EXPECT_EQ(refused("{\"schema\": \"run/2\"}"), "E-CELL-EARLIER");
  EXPECT_EQ(refused("{\"schema\": \"run/1\"}"), "E-CELL-EARLIER");
  EXPECT_EQ(refused(run_of(estimate("frame.x", false, "1"), "1")), "E-CELL-EARLIER");
  EXPECT_EQ(refused(run_of(estimate("J1.a", true, "1e999"), "1")), "E-CELL-EARLIER");
  EXPECT_EQ(refused(run_of(estimate("J1.a", true, "1"), "-1")), "E-CELL-EARLIER");
  EXPECT_EQ(refused(run_of(estimate("J1.a", true, "1"), "")), "E-CELL-EARLIER");
  EXPECT_EQ(refused(run_of(estimate("J1.a", true, "1"), "1", "\"base\": \"controller\",")),
            "E-CELL-EARLIER");
  std::string summed = run_of(estimate("J1.a", true, "1"), "1");
  summed.back() = ',';
  summed += "\"checksum\": \"" + std::string(64, '0') + "\"}\n";
  EXPECT_EQ(refused(summed), "E-CELL-EARLIER");
  EXPECT_EQ(problems_of([&] { earlier_arm(folder.path() / "nowhere"); }).size(), 1U);
}

}  // namespace
}  // namespace plumb::offline
