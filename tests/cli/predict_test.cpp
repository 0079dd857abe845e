// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "sandbox.hpp"

namespace {

using Json = nlohmann::ordered_json;

struct Errors {
  std::vector<double> mm;
  double mean = 0.0, rms = 0.0, max = 0.0;
};

/// Recomputed from the file alone: rows of a set, or all that have a fold.
Errors errors_of(const Csv& csv, const std::string& set) {
  Errors out;
  for (std::size_t i = 0; i < csv.rows(); ++i) {
    if (csv.columns.at("set")[i] != set) continue;
    double squares = 0.0;
    for (const auto* axis : {"x_mm", "y_mm", "z_mm"}) {
      if (!csv.columns.contains(axis)) continue;
      squares += std::pow(std::stod(csv.columns.at(axis)[i]) -
                              std::stod(csv.columns.at(std::string("p") + axis)[i]),
                          2);
    }
    out.mm.push_back(std::sqrt(squares));
  }
  for (double e : out.mm) {
    out.mean += e / static_cast<double>(out.mm.size());
    out.rms += e * e / static_cast<double>(out.mm.size());
    out.max = std::max(out.max, e);
  }
  out.rms = std::sqrt(out.rms);
  return out;
}

void expect_same(const Errors& recomputed, const Json& reported, const Json& count) {
  EXPECT_EQ(static_cast<int>(recomputed.mm.size()), count.get<int>());
  EXPECT_NEAR(recomputed.mean, reported.at("mean_mm").get<double>(), 1e-6);
  EXPECT_NEAR(recomputed.rms, reported.at("rms_mm").get<double>(), 1e-6);
  EXPECT_NEAR(recomputed.max, reported.at("max_mm").get<double>(), 1e-6);
}

TEST(PredictAsMeasured, RecomputesTheHeldOutErrorThatFitReported) {
  for (const auto* demo : {"compliance", "scara", "beam"})
    for (const auto* rule : {"20%", "kfold:5"}) {
      const Sandbox box;
      ASSERT_EQ(box.plumb({"demo", demo, "cell"}).exit, 0);
      const Ran fit = box.plumb({"-C", "cell", "fit", "--held-out", rule, "--json"});
      ASSERT_EQ(fit.exit, 0) << fit.err;
      const Ran ran = box.plumb({"-C", "cell", "predict", "--as-measured", "-o", "out.csv"});
      ASSERT_EQ(ran.exit, 0) << ran.err;
      const Json result = fit.json().at("result");
      expect_same(errors_of(box.csv("out.csv"), "held"), result.at("held_out"),
                  result.at("poses_held_out"));
    }
}

TEST(PredictAsMeasured, MarksEveryRowAndKeepsTheInputAsWritten) {
  const Sandbox box;
  ASSERT_EQ(box.plumb({"demo", "gear", "cell"}).exit, 0);
  ASSERT_EQ(box.plumb({"-C", "cell", "fit", "--held-out", "kfold:5"}).exit, 0);
  const Ran ran = box.plumb({"-C", "cell", "predict", "--as-measured"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const Csv out = parse_csv(ran.out), in = box.csv("cell/measurements.csv");
  ASSERT_EQ(out.rows(), in.rows());
  for (const auto& name : in.header) EXPECT_EQ(out.columns.at(name), in.columns.at(name)) << name;
  for (double fold : out.numbers("fold")) EXPECT_TRUE(fold >= 0 && fold < 5);
  for (const auto& set : out.columns.at("set")) EXPECT_EQ(set, "held");
}

TEST(PredictAsMeasured, PosesOfAnotherFileArePredictedByTheFinalModel) {
  const Sandbox box;
  ASSERT_EQ(box.plumb({"demo", "clean", "cell"}).exit, 0);
  ASSERT_EQ(box.plumb({"-C", "cell", "fit", "--held-out", "20%"}).exit, 0);
  ASSERT_EQ(box.plumb({"-C", "cell", "predict", "--as-measured", "-o", "own.csv"}).exit, 0);
  ASSERT_EQ(box.plumb({"-C", "cell", "predict", "--as-measured", "--run", "1", "--data",
                       "cell/measurements.csv", "-o", "other.csv"})
                .exit,
            0);
  const Csv own = box.csv("own.csv"), other = box.csv("other.csv");
  EXPECT_FALSE(other.columns.contains("set"));
  for (const auto* column : {"px_mm", "py_mm", "pz_mm"}) {
    const auto a = own.numbers(column), b = other.numbers(column);
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-9);
  }
}

TEST(PredictAsMeasured, ReplacesColumnsOfThatNameWithANote) {
  const Sandbox box;
  ASSERT_EQ(box.plumb({"demo", "clean", "cell"}).exit, 0);
  ASSERT_EQ(box.plumb({"-C", "cell", "compile"}).exit, 0);
  ASSERT_EQ(box.plumb({"predict", "cell/robot.plumb", "--data", "cell/measurements.csv", "-o",
                       "once.csv"})
                .exit,
            0);
  const Ran again =
      box.plumb({"predict", "cell/robot.plumb", "--data", "once.csv", "-o", "twice.csv"});
  ASSERT_EQ(again.exit, 0) << again.err;
  EXPECT_NE(again.err.find("note[N-CSV-REPLACED]"), std::string::npos);
  EXPECT_EQ(box.read("once.csv"), box.read("twice.csv"));
}

TEST(Predict, TheToolPointIsTheMeasuredPointMinusFrameAndTarget) {
  const Sandbox box;
  ASSERT_EQ(box.plumb({"demo", "clean", "cell"}).exit, 0);
  const Json fit = box.plumb({"-C", "cell", "fit", "--held-out", "20%", "--json"}).json();
  ASSERT_EQ(box.plumb({"-C", "cell", "compile"}).exit, 0);
  ASSERT_EQ(box.plumb({"-C", "cell", "predict", "--as-measured", "-o", "m.csv"}).exit, 0);
  ASSERT_EQ(
      box.plumb({"predict", "cell/robot.plumb", "--data", "cell/measurements.csv", "-o", "b.csv"})
          .exit,
      0);
  const auto rotated = [](const std::vector<double>& q, const std::vector<double>& v) {
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    return std::vector<double>{
        (1 - 2 * (y * y + z * z)) * v[0] + 2 * (x * y - w * z) * v[1] + 2 * (x * z + w * y) * v[2],
        2 * (x * y + w * z) * v[0] + (1 - 2 * (x * x + z * z)) * v[1] + 2 * (y * z - w * x) * v[2],
        2 * (x * z - w * y) * v[0] + 2 * (y * z + w * x) * v[1] + (1 - 2 * (x * x + y * y)) * v[2]};
  };
  const auto frame = fit.at("result").at("frame");
  const std::vector<double> target = fit.at("result").at("target_mm");
  const std::vector<double> p_M = frame.at("xyz_mm"), q_M = frame.at("quat_wxyz");
  const Csv m = box.csv("m.csv"), b = box.csv("b.csv");
  for (std::size_t i = 0; i < b.rows(); i += 7) {
    std::vector<double> tool;
    for (const auto* name : {"pqw", "pqx", "pqy", "pqz"}) tool.push_back(b.numbers(name)[i]);
    const auto offset = rotated(tool, target);
    const auto in_M =
        rotated(q_M, {b.numbers("px_mm")[i] + offset[0], b.numbers("py_mm")[i] + offset[1],
                      b.numbers("pz_mm")[i] + offset[2]});
    EXPECT_NEAR(in_M[0] + p_M[0], m.numbers("px_mm")[i], 1e-6);
    EXPECT_NEAR(in_M[1] + p_M[1], m.numbers("py_mm")[i], 1e-6);
    EXPECT_NEAR(in_M[2] + p_M[2], m.numbers("pz_mm")[i], 1e-6);
  }
}

TEST(PredictAsMeasured, ARunOfOtherMeasurementsIsRefused) {
  const Sandbox box;
  ASSERT_EQ(box.plumb({"demo", "clean", "cell"}).exit, 0);
  ASSERT_EQ(box.plumb({"-C", "cell", "fit"}).exit, 0);
  ASSERT_EQ(box.plumb({"-C", "cell", "simulate", "--seed", "8", "--force"}).exit, 0);
  const Ran ran =
      box.plumb({"-C", "cell", "predict", "--as-measured", "--run", "1", "-o", "x.csv", "--json"});
  EXPECT_EQ(ran.exit, 3);
  EXPECT_EQ(ran.json().at("error").at("code"), "E-RUN-DATA");
}

}  // namespace
