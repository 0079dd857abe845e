// SPDX-License-Identifier: Apache-2.0
// What `plumb simulate` hides, and how it is measured.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sandbox.hpp"

namespace {

using Json = nlohmann::ordered_json;

class Simulate : public testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(box.plumb({"demo", "clean", "cell"}).exit, 0); }

  Ran run(std::vector<std::string> words) const {
    words.insert(words.begin(), {"-C", "cell", "simulate", "--force"});
    return box.plumb(words);
  }
  Json truth() const { return Json::parse(box.read("cell/truth.json")); }
  Csv data() const { return box.csv("cell/measurements.csv"); }
  Sandbox box;
};

TEST_F(Simulate, HidesAnEffectOfTheSizeThatWasAskedForInSigma) {
  const Ran ran = run({"--effect", "gear_ripple:J2:5@cycles=20", "--sigma-um", "20", "--json"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_NEAR(ran.json().at("result").at("sizes").at(0).at("visible_um"), 100.0, 1.0);
  const Json effect = truth().at("effects").at(0);
  EXPECT_EQ(effect.at("class"), "gear_ripple");
  EXPECT_EQ(effect.at("joints").at(0), "J2");
  EXPECT_EQ(effect.at("numbers").at(0).at("cycles_per_turn"), 20.0);
  EXPECT_NEAR(effect.at("size").at("visible_sigma"), 5.0, 0.05);
}

TEST_F(Simulate, WritesTheContextsThatWereAskedForAndTheStrictReaderTakesThem) {
  const Ran ran = run({"--poses",      "120",       "--payloads", "0,1.5,3",    "--temperatures",
                       "--directions", "--held",    "25%",        "--outliers", "2%",
                       "--order",      "nearest",   "--grid",     "9",          "--range",
                       "80%",          "--seconds", "60",         "--effect",   "drift::2"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const Csv csv = data();
  for (const char* column : {"set", "t_s", "payload_kg", "payload_cx_mm", "temp_degC",
                             "temp_room_degC", "temp_elbow_degC", "dir_j6", "travel_j6_deg"}) {
    EXPECT_EQ(csv.columns.count(column), 1U) << column;
  }
  EXPECT_EQ(truth().at("outliers").size(), 2U);
  const auto t = csv.numbers("t_s");
  EXPECT_EQ(t.at(1) - t.at(0), 60.0);
  const auto q = csv.numbers("q1_deg");
  EXPECT_LE(*std::max_element(q.begin(), q.end()), 0.8 * 170.0 + 1e-9);
  const Ran fitted = box.plumb({"-C", "cell", "fit"});
  EXPECT_EQ(fitted.exit, 0) << fitted.err;
}

TEST_F(Simulate, FreshPosesAreOfTheSameArmWithoutNoise) {
  ASSERT_EQ(run({"--effect", "joint_compliance:J2=300urad", "--noise-um", "0.000001", "--fresh",
                 "fresh.csv", "--fresh-poses", "60"})
                .exit,
            0);
  const Csv fresh = box.csv("fresh.csv");
  EXPECT_EQ(fresh.rows(), 60U);
  EXPECT_NE(fresh.columns.at("q1_deg").front(), data().columns.at("q1_deg").front());
  // An arm that bends at J2 alone is seen with the same geometry by both files.
  ASSERT_EQ(box.plumb({"-C", "cell", "fit"}).exit, 0);
  const Ran own = box.plumb({"-C", "cell", "predict", "--as-measured", "-o", "own.csv"});
  ASSERT_EQ(own.exit, 0) << own.err;
  const Ran other = box.plumb(
      {"-C", "cell", "predict", "--as-measured", "--data", "fresh.csv", "-o", "other.csv"});
  ASSERT_EQ(other.exit, 0) << other.err;
  const auto rms = [&](const std::string& file) {
    const Csv csv = box.csv(file);
    double sum = 0.0;
    for (const char* axis : {"x_mm", "y_mm", "z_mm"}) {
      const auto measured = csv.numbers(axis), predicted = csv.numbers(std::string("p") + axis);
      for (std::size_t k = 0; k < measured.size(); ++k) {
        sum += std::pow(measured[k] - predicted[k], 2) / static_cast<double>(measured.size());
      }
    }
    return std::sqrt(sum);
  };
  EXPECT_GT(rms("own.csv"), 0.02) << "something is missing";
  EXPECT_LT(rms("other.csv"), 2.0 * rms("own.csv"));
}

TEST_F(Simulate, TheTruthNamesWhatMakesTheArmInconvenient) {
  const Ran ran = run({"--joint-scatter-urad", "25", "--encoder-step-urad", "100", "--revisits",
                       "20", "--true-gravity", "0,-9.81,0", "--coupled-drives", "J3"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const Json imperfections = truth().at("imperfections");
  EXPECT_NEAR(imperfections.at("joint_scatter_urad").at(0), 25.0, 1e-9);
  EXPECT_NEAR(imperfections.at("encoder_step_urad"), 100.0, 1e-9);
  EXPECT_EQ(imperfections.at("gravity_m_per_s2"), Json({0.0, -9.81, 0.0}));
  EXPECT_EQ(imperfections.at("coupled_drives"), Json({"J3"}));
  const Csv csv = data();
  EXPECT_EQ(csv.rows(), 170U);
  EXPECT_EQ(csv.columns.at("pose").back(), "P143") << "the last of every 7.5th pose";
  for (const double q_deg : csv.numbers("q2_deg")) {
    const double steps = q_deg * M_PI / 180.0 / 100e-6;
    EXPECT_NEAR(steps, std::round(steps), 1e-6);
  }
  ASSERT_EQ(run({}).exit, 0);
  EXPECT_FALSE(truth().contains("imperfections")) << "nothing was asked for";
}

TEST_F(Simulate, MistakesAreUsageErrorsWithHelp) {
  const std::vector<std::vector<std::string>> mistakes{
      {"--effect", "gear_ripple:J2:5@cicles=20"},
      {"--effect", "gear_ripple:J2:zero"},
      {"--effect", "drift=3um::2"},
      {"--outliers", "150%"},
      {"--outliers", "many"},
      {"--grid", "1"},
      {"--order", "random"},
      {"--coupled-drives", "J7"},
      {"--coupled-drives", "J1"},
      {"--true-gravity", "0,-9.81"},
      {"--joint-scatter-urad", "1,2,3"},
      {"--revisits", "151"},
      {"--effect", "payload_compliance:J1:3"},
      {"--effect", "thermal_growth::3", "--constant-temperature"}};
  for (const auto& words : mistakes) {
    const Ran ran = run(words);
    EXPECT_EQ(ran.exit, 2) << words[1];
    EXPECT_NE(ran.err.find("error["), std::string::npos) << words[1] << ran.err;
    EXPECT_NE(ran.err.find("= help: "), std::string::npos) << words[1] << ran.err;
  }
}

}  // namespace
