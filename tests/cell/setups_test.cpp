// SPDX-License-Identifier: Apache-2.0
#include "cell/setups.hpp"
#include "cell/measurement_reader.hpp"

#include "cell/replicates.hpp"
#include "support.hpp"

namespace plumb::offline {
namespace {

const std::string kRobot =
    "schema = \"cell/1\"\n"
    "[robot]\n"
    "dh_convention = \"standard\"\n"
    "joints = [{ name = \"J1\", a = 100, q = [-90, 90] }]\n"
    "[measurement]\n";

Cell cell_with(const std::string& text, const std::filesystem::path& file = "/c/cell.toml") {
  return parse_cell(kRobot + text, file);
}

/// Line numbers count from [measurement], which is line 5.
Summary errors_of(const std::string& text) {
  return summary(problems_of([&] { cell_with(text); }));
}

const std::string kThree =
    "frame = { xyz = [1000, 0, 0], rpy = [0, 0, 90] }\n"
    "[[measurement.setup]]\n"
    "name = \"day 1\"\n"
    "files = [\"a.csv\"]\n"
    "frame = \"fit\"\n"
    "target = [1, 2, 3]\n"
    "[[measurement.setup]]\n"
    "name = \"day 2\"\n"
    "files = [\"b.csv\", \"c.csv\"]\n"
    "frame = { same_as = \"day 1\" }\n"
    "[[measurement.setup]]\n"
    "name = \"day 3\"\n"
    "files = [\"d.csv\"]\n"
    "target = { same_as = \"day 1\" }\n";

TEST(Setups, AreReadWithTheirOwnFrameAndTarget) {
  const Cell c = cell_with(kThree);
  const auto& m = c.measurement;
  EXPECT_TRUE(m.files.empty());  // every set-up names files
  ASSERT_EQ(m.setups.size(), 3u);
  EXPECT_TRUE(m.setups[0].fit_frame);
  EXPECT_FALSE(m.setups[0].fit_target);
  EXPECT_EQ(m.setups[1].frame_of, 0);
  EXPECT_TRUE(m.setups[1].fit_target);  // as [measurement], which says nothing: fit
  EXPECT_EQ(m.setups[1].files.size(), 2u);
  EXPECT_FALSE(m.setups[2].fit_frame);  // as [measurement]
  EXPECT_EQ(m.setups[2].X_MB.p[0], 1.0);
  EXPECT_EQ(setup_rule(m, 1).fit_frame, true);
  EXPECT_EQ(setup_rule(m, 2).target_T, (std::array<double, 3>{0.001, 0.002, 0.003}));
  EXPECT_EQ(measurement_files(m).size(), 4u);
}

TEST(Setups, SurviveBeingWrittenAndRead) {
  const Cell c = cell_with(kThree);
  const Cell back = parse_cell(write_cell(c), "/c/cell.toml");
  EXPECT_EQ(back.measurement.files, c.measurement.files);
  ASSERT_EQ(back.measurement.setups.size(), 3u);
  for (int k = 0; k < 3; ++k) {
    const offline::Setup &a = c.measurement.setups[k], &b = back.measurement.setups[k];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.files, b.files);
    EXPECT_EQ(a.frame_of, b.frame_of);
    EXPECT_EQ(a.target_of, b.target_of);
    const offline::Setup x = setup_rule(c.measurement, k), y = setup_rule(back.measurement, k);
    EXPECT_EQ(x.fit_frame, y.fit_frame);
    EXPECT_EQ(x.fit_target, y.fit_target);
    EXPECT_EQ(x.target_T, y.target_T);
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(x.X_MB.q[i], y.X_MB.q[i], 1e-15);
  }
}

TEST(Setups, ThatContradictThemselvesAreRefusedWhereTheyStand) {
  const std::string a = "[[measurement.setup]]\nname = \"a\"\nfiles = [\"a.csv\"]\n";
  EXPECT_EQ(errors_of(a + "[[measurement.setup]]\nname = \"a\"\n"), Summary{"E-CELL-SETUP 10:8"});
  EXPECT_EQ(errors_of(a + "[[measurement.setup]]\nname = \"b\"\nfiles = [\"a.csv\"]\n"),
            Summary{"E-CELL-SETUP 11:10"});
  EXPECT_EQ(errors_of("[[measurement.setup]]\nname = \"a\"\nfiles = [\"a.csv\", \"a.csv\"]\n"),
            Summary{"E-CELL-SETUP 8:19"});
  EXPECT_EQ(errors_of(a + "frame = { same_as = \"b\" }\n"), Summary{"E-CELL-SETUP 9:21"});
  EXPECT_EQ(errors_of(a + "target = { same_as = \"a\" }\n"), Summary{"E-CELL-SETUP 9:22"});
  EXPECT_EQ(errors_of(a + "frame = \"fitted\"\n"), Summary{"E-CELL-RANGE 9:9"});
  EXPECT_EQ(errors_of(a + "frmae = \"fit\"\n"), Summary{"E-CELL-KEY 9:1"});
  EXPECT_EQ(errors_of(a + "target = [1, 2]\n"), Summary{"E-CELL-TYPE 9:10"});
  EXPECT_EQ(errors_of("[[measurement.setup]]\nfiles = [\"a.csv\"]\n"),
            Summary{"E-CELL-MISSING 6:1"});
}

class SetupRows : public testing::Test {
 protected:
  MeasurementFiles read(const std::string& settings) {
    const Cell cell = cell_with(settings, folder_.path() / "cell.toml");
    const auto files = measurement_files(cell.measurement);
    MeasurementFiles m = read_measurements(files, {true}, Needs::kJointsAndPosition);
    assign_setups(cell, files, m);
    return m;
  }
  Summary errors(const std::string& settings) {
    return summary(problems_of([&] { read(settings); }));
  }
  const std::string two_ =
      "[[measurement.setup]]\nname = \"a\"\n[[measurement.setup]]\nname = \"b\"\n";
  const std::string files_ =
      "[[measurement.setup]]\nname = \"a\"\nfiles = [\"a.csv\"]\n"
      "[[measurement.setup]]\nname = \"b\"\nfiles = [\"b.csv\"]\n";
  Folder folder_;
};

TEST_F(SetupRows, BelongToTheSetupOfTheirFileOrOfTheirColumn) {
  folder_.put("a.csv", "q1_deg,x_mm\n1,2\n2,3\n");
  folder_.put("b.csv", "q1_deg,x_mm\n1,2\n");
  EXPECT_EQ(read(files_).setup, (std::vector<int>{0, 0, 1}));
  folder_.put("m.csv", "q1_deg,setup,x_mm\n1,b,2\n2,a,3\n3,b,4\n");
  const MeasurementFiles m = read("files = [\"m.csv\"]\n" + two_);
  EXPECT_EQ(m.setup, (std::vector<int>{1, 0, 1}));
  EXPECT_EQ(pick(m, {2, 1}).setup, (std::vector<int>{1, 0}));
}

TEST_F(SetupRows, OfOnePoseAreNoRepeatsInDifferentSetupsButOnePoseOfTheArm) {
  folder_.put("a.csv", "pose,q1_deg,x_mm\nP,1,2\nP,1,2.1\n");
  folder_.put("b.csv", "pose,q1_deg,x_mm\nP,1,7\nQ,1,7.1\n");
  const MeasurementFiles m = read(files_);
  EXPECT_EQ(m.replicate_group, (std::vector<int>{0, 0, 1, 1}));
  EXPECT_EQ(pose_groups(m), (std::vector<int>{0, 0, 0, 0}));
}

TEST_F(SetupRows, ThatBelongToNoneOrTwoAreRefused) {
  folder_.put("a.csv", "q1_deg,setup,x_mm\n1,,2\n2,b,3\n");
  folder_.put("b.csv", "q1_deg,x_mm\n1,2\n");
  EXPECT_EQ(errors(files_), Summary{"E-CSV-SETUP 3:3"});  // says b, but its file is a's
  folder_.put("m.csv", "q1_deg,setup,x_mm\n1,b,2\n2,c,3\n3,,4\n4,c,5\n");
  EXPECT_EQ(errors("files = [\"m.csv\"]\n" + two_),
            (Summary{"E-CSV-SETUP 3:3", "E-CSV-SETUP 4:3"}));
  EXPECT_EQ(errors("files = [\"b.csv\"]\n" + two_), Summary{"E-CSV-SETUP 1:12"});
}

TEST_F(SetupRows, MustExistForEverySetup) {
  folder_.put("m.csv", "q1_deg,setup,x_mm\n1,a,2\n");
  EXPECT_EQ(errors("files = [\"m.csv\"]\n" + two_), Summary{"E-CSV-SETUP 9:1"});
}

TEST_F(SetupRows, ToBePredictedSayTheirSetupOrStandInAFileThatASetupNames) {
  const Cell cell = cell_with("files = [\"m.csv\"]\n" + two_);
  const auto rows_of = [&](const std::string& text) {
    MeasurementFiles rows = read_measurements({folder_.put("p.csv", text)}, {true}, Needs::kJoints);
    assign_setups_to_predict(cell, folder_.put("p.csv", text), rows);
    return rows;
  };
  const MeasurementFiles said = rows_of("q1_deg,setup\n1,b\n2,a\n");
  EXPECT_EQ(said.setup, (std::vector<int>{1, 0}));
  EXPECT_TRUE(said.tables[0].remarks.empty());
  EXPECT_EQ(summary(problems_of([&] { rows_of("q1_deg\n1\n2\n"); })), Summary{"E-CSV-SETUP 1:7"});
  EXPECT_EQ(summary(problems_of([&] { rows_of("q1_deg,setup\n1,c\n"); })),
            Summary{"E-CSV-SETUP 2:3"});
}

TEST_F(SetupRows, OfSeveralSetupsInACellWithNoneAreWarnedOf) {
  folder_.put("m.csv", "q1_deg,setup,x_mm\n1,a,2\n2,b,3\n");
  const MeasurementFiles m = read("files = [\"m.csv\"]\n");
  EXPECT_TRUE(m.setup.empty());
  EXPECT_EQ(summary(m.tables[0].remarks), Summary{"W-CSV-SETUP 1:8"});
}

}  // namespace
}  // namespace plumb::offline
