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

/// The rows of a file in this order, without some columns.
std::string reordered(const Csv& csv, const std::vector<std::size_t>& order,
                      const std::vector<std::string>& without) {
  std::string out;
  const auto line = [&](auto text) {
    std::string row;
    for (const auto& name : csv.header)
      if (std::find(without.begin(), without.end(), name) == without.end())
        row += (row.empty() ? "" : ",") + text(name);
    out += row + "\n";
  };
  line([](const std::string& name) { return name; });
  for (const std::size_t i : order)
    line([&](const std::string& name) { return csv.columns.at(name)[i]; });
  return out;
}

/// Every third row, then every third of the others, backwards.
std::vector<std::size_t> shuffled(std::size_t rows) {
  std::vector<std::size_t> out;
  for (std::size_t first : {2, 0, 1})
    for (std::size_t i = first; i < rows; i += 3) out.insert(out.begin(), i);
  return out;
}

std::vector<std::string> columns_like(const Csv& csv, const std::string& prefix) {
  std::vector<std::string> out;
  for (const auto& name : csv.header)
    if (name.starts_with(prefix)) out.push_back(name);
  return out;
}

/// A simulated arm with an effect that depends on more than the joints, and its fitted cell.
class OtherOrder {
 public:
  OtherOrder(const std::vector<std::string>& simulated, const std::string& effects) {
    EXPECT_EQ(box.plumb({"demo", "clean", "cell"}).exit, 0);
    std::vector<std::string> words{"-C",      "cell", "simulate",  "--force",
                                   "--poses", "90",   "--repeats", "1"};
    words.insert(words.end(), simulated.begin(), simulated.end());
    const Ran made = box.plumb(words);
    EXPECT_EQ(made.exit, 0) << made.err;
    box.write("cell/cell.toml", with_effects(box.read("cell/cell.toml"), effects));
    const Ran fit = box.plumb({"-C", "cell", "fit", "--held-out", "20%"});
    EXPECT_EQ(fit.exit, 0) << fit.err;
    EXPECT_EQ(box.plumb({"-C", "cell", "predict", "--as-measured", "-o", "own.csv"}).exit, 0);
    own = box.csv("own.csv");
    csv = box.csv("cell/measurements.csv");
  }

  /// Largest distance [mm] between what is said of these rows in another file and in their place.
  double difference(const std::vector<std::size_t>& order,
                    const std::vector<std::string>& without) {
    box.write("other.csv", reordered(csv, order, without));
    ran = box.plumb({"-C", "cell", "predict", "--as-measured", "--run", "1", "--data", "other.csv",
                     "-o", "out.csv", "--force", "--json"});
    EXPECT_EQ(ran.exit, 0) << ran.err << ran.out;
    out = box.csv("out.csv");
    double worst = 0.0;
    for (const auto* column : {"px_mm", "py_mm", "pz_mm"}) {
      const auto here = out.numbers(column), there = own.numbers(column);
      for (std::size_t i = 0; i < order.size(); ++i)
        worst = std::max(worst, std::abs(here[i] - there[order[i]]));
    }
    return worst;
  }

  std::size_t count(const std::string& status) const {
    const auto& all = out.columns.at("status");
    return static_cast<std::size_t>(std::count(all.begin(), all.end(), status));
  }

  std::string warning(const std::string& code) const {
    const Json all = ran.json();
    for (const auto& remark : all.at("warnings"))
      if (remark.at("code") == code) return remark.dump();
    return "";
  }

  static std::string with_effects(std::string text, const std::string& effects) {
    const std::size_t at = text.find("geometry = true");
    EXPECT_NE(at, std::string::npos);
    return text.insert(at + std::string("geometry = true").size(), "\n" + effects + "\n");
  }

  Sandbox box;
  Csv own, csv, out;
  Ran ran;
};

TEST(PredictAsMeasured, LagComesFromTheColumnsInWhateverOrderTheRowsStand) {
  OtherOrder arm({"--effect", "settling_lag:J2:20", "--directions"},
                 "[effects.settling_lag]\njoints = [\"J2\", \"J3\"]");
  const auto order = shuffled(arm.csv.rows());
  EXPECT_LT(arm.difference(order, {"pose", "t_s"}), 1e-6);
  EXPECT_EQ(arm.count("context-fallback"), 0u);
  auto moves = columns_like(arm.csv, "dir_j");
  for (const auto& name : columns_like(arm.csv, "travel_j")) moves.push_back(name);
  moves.insert(moves.end(), {"pose", "t_s"});
  EXPECT_GT(arm.difference(order, moves), 1e-3);
  EXPECT_EQ(arm.count("ok"), 0u);
  EXPECT_GT(arm.count("context-fallback"), 0u);
  const std::string warning = arm.warning("W-PREDICT-INPUT");
  EXPECT_NE(warning.find("settling_lag"), std::string::npos) << arm.ran.out;
  EXPECT_NE(warning.find("dir_jN"), std::string::npos) << warning;
}

TEST(PredictAsMeasured, StepsAndDriftGoByTimeOrPoseNotByTheRowsOfAnotherFile) {
  for (const std::string effects :
       {"[[effects.step]]\nafter_row = 30\nof = \"tool\"", "[effects.drift]"}) {
    OtherOrder arm({"--effect", effects[1] == '[' ? "step_reflector::20" : "drift::20"}, effects);
    const auto order = shuffled(arm.csv.rows());
    EXPECT_LT(arm.difference(order, {"pose"}), 1e-6) << effects;
    EXPECT_LT(arm.difference(order, {"t_s"}), 1e-6) << effects;
    EXPECT_EQ(arm.count("context-fallback"), 0u);
    EXPECT_EQ(arm.warning("W-PREDICT-INPUT"), "");
    EXPECT_EQ(arm.ran.json().at("result").at("rows_without_place"), 0);
    arm.difference(order, {"pose", "t_s"});
    EXPECT_EQ(arm.count("ok"), 0u);
    EXPECT_EQ(arm.ran.json().at("result").at("rows_without_place"), arm.csv.rows());
    EXPECT_NE(arm.warning("W-PREDICT-INPUT").find("t_s"), std::string::npos) << arm.ran.out;
  }
}

TEST(PredictAsMeasured, RowsOfUnknownTimeAreAsAfterTheLastRowOfTheCell) {
  OtherOrder arm({"--effect", "step_reflector::20"},
                 "[[effects.step]]\nafter_row = 30\nof = \"tool\"");
  std::vector<std::size_t> late;
  for (std::size_t i = 40; i < arm.csv.rows(); ++i) late.push_back(i);
  EXPECT_LT(arm.difference(late, {"pose", "t_s"}), 1e-6);
  EXPECT_GT(arm.difference({1, 2, 3}, {"pose", "t_s"}), 1e-3);
}

TEST(PredictAsMeasured, JointsBeyondThePosesOfTheFitAreNotOkWithoutATree) {
  const Sandbox box;
  ASSERT_EQ(box.plumb({"demo", "clean", "cell"}).exit, 0);
  ASSERT_EQ(
      box.plumb({"-C", "cell", "simulate", "--force", "--range", "30%", "--poses", "80"}).exit, 0);
  ASSERT_EQ(box.plumb({"-C", "cell", "compile"}).exit, 0);
  box.write("far.csv",
            "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n150,-70,20,0,0,0\n0,-70,20,0,0,0\n");
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"-C", "cell", "predict", "--as-measured"},
        std::vector<std::string>{"predict", "cell/robot.plumb"}}) {
    auto all = words;
    all.insert(all.end(), {"--data", "far.csv", "-o", "out.csv", "--force"});
    const Ran ran = box.plumb(all);
    ASSERT_EQ(ran.exit, 0) << ran.err;
    const auto status = box.csv("out.csv").columns.at("status");
    EXPECT_EQ(status[0], "outside-domain");
    EXPECT_EQ(status[1], "ok");
    EXPECT_NE(ran.err.find("W-PREDICT-OUTSIDE"), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find("1 of 2 rows"), std::string::npos) << ran.err;
  }
}

/// The joints of the clean demo's measurements, times a factor.
std::string scaled_joints(const Sandbox& box, double factor) {
  const Csv csv = box.csv("cell/measurements.csv");
  std::string out = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n";
  for (std::size_t i = 0; i < csv.rows(); ++i)
    for (int j = 1; j <= 6; ++j)
      out += std::to_string(csv.numbers("q" + std::to_string(j) + "_deg")[i] * factor) +
             (j == 6 ? "\n" : ",");
  return out;
}

TEST(Predict, AsksWhetherRadiansStandInColumnsOfDegrees) {
  const Sandbox box;
  ASSERT_EQ(box.plumb({"demo", "clean", "cell"}).exit, 0);
  ASSERT_EQ(box.plumb({"-C", "cell", "compile"}).exit, 0);
  const auto asks = [&](const std::string& rows, bool as_measured) {
    box.write("rows.csv", rows);
    std::vector<std::string> words{"-C", "cell", "predict", "--as-measured"};
    if (!as_measured) words = {"predict", "cell/robot.plumb"};
    words.insert(words.end(), {"--data", "rows.csv", "-o", "out.csv", "--force"});
    const Ran ran = box.plumb(words);
    EXPECT_EQ(ran.exit, 0) << ran.err;
    return ran.err.find("radians in q1_deg ...?") != std::string::npos;
  };
  const std::string radians = scaled_joints(box, 3.14159265358979 / 180.0);
  std::string named = radians;
  for (std::size_t at = 0; (at = named.find("_deg", at)) != std::string::npos;)
    named.replace(at, 4, "_rad");
  for (const bool as_measured : {false, true}) {
    EXPECT_TRUE(asks(radians, as_measured));
    EXPECT_FALSE(asks(named, as_measured));
    EXPECT_FALSE(asks(scaled_joints(box, 1.0), as_measured));
    EXPECT_FALSE(asks("q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n0,0,0,0,0,0\n", as_measured));
  }
}

}  // namespace
