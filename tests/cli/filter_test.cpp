// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "sandbox.hpp"

namespace {

using Json = nlohmann::ordered_json;
using Pose = Eigen::Isometry3d;

constexpr double kDeg = 3.14159265358979323846 / 180.0;

/// x, y, z [mm] and turns about the fixed axes x, y, z [deg].
Pose pose(double x, double y, double z, double w, double p, double r) {
  Pose out = Pose::Identity();
  out.translation() = Eigen::Vector3d(x, y, z);
  out.linear() = (Eigen::AngleAxisd(r * kDeg, Eigen::Vector3d::UnitZ()) *
                  Eigen::AngleAxisd(p * kDeg, Eigen::Vector3d::UnitY()) *
                  Eigen::AngleAxisd(w * kDeg, Eigen::Vector3d::UnitX()))
                     .toRotationMatrix();
  return out;
}

/// The lengths of the heavy arm of the demo, in its plane: the wrist before axis 1 and before the
/// lower arm.
bool in_front(const std::vector<double>& q) {
  const double upper = q[1] * kDeg, fore = (q[1] + q[2]) * kDeg;
  const double ux = 950 * std::sin(upper), uz = 950 * std::cos(upper);
  const double wx = ux + 800 * std::sin(fore), wz = uz + 800 * std::cos(fore);
  return 250 + wx > 1.0 && uz * wx - ux * wz > 1.0;
}

struct Case {
  Pose X_BT;              // [mm]
  std::vector<double> q;  // [deg]
};

std::string without_returns(std::string text) {
  std::erase(text, '\r');
  return text;
}

std::vector<std::string> lines_of_text(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

/// The text after a unified diff, as `patch` would make it; what does not fit is a failure.
std::string applied(const std::string& text, const std::string& diff) {
  const auto before = lines_of_text(text);
  std::string out;
  std::size_t at = 0;
  for (const std::string& line : lines_of_text(diff)) {
    if (line.rfind("--- ", 0) == 0 || line.rfind("+++ ", 0) == 0 || line.empty()) continue;
    if (line[0] == '@') {
      const auto first = static_cast<std::size_t>(std::stoul(line.substr(line.find('-') + 1)));
      while (at + 1 < first) out += before.at(at++) + "\n";
      continue;
    }
    if (line[0] != '+') {
      EXPECT_EQ(before.at(at), line.substr(1));
      ++at;
    }
    if (line[0] != '-') out += line.substr(1) + "\n";
  }
  while (at < before.size()) out += before[at++] + "\n";
  return out;
}

/// A cell, its model, and the targets of the demo that stand as most programs do.
class FilterVerb : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    box = new Sandbox;
    ASSERT_EQ(box->plumb({"demo", "compliance", "cell"}).exit, 0);
    ASSERT_EQ(box->plumb({"-C", "cell", "compile"}).exit, 0);
    cases = new std::vector<Case>(cases_of("cell", true));
    ASSERT_GE(cases->size(), 4U);
  }
  static void TearDownTestSuite() {
    delete cases;
    delete box;
  }

  static std::vector<Case> cases_of(const std::string& cell, bool front_only) {
    std::vector<Case> out;
    const Csv csv = box->csv(cell + "/targets.csv");
    for (std::size_t i = 0; i < csv.rows(); ++i) {
      const auto at = [&](const char* name) { return csv.numbers(name)[i]; };
      Case one{Pose::Identity(), {}};
      one.X_BT.translation() = Eigen::Vector3d(at("x_mm"), at("y_mm"), at("z_mm"));
      one.X_BT.linear() =
          Eigen::Quaterniond(at("qw"), at("qx"), at("qy"), at("qz")).toRotationMatrix();
      for (int j = 1; j <= 6; ++j) one.q.push_back(at(("q" + std::to_string(j) + "_deg").c_str()));
      if (!front_only || in_front(one.q)) out.push_back(one);
    }
    return out;
  }

  /// What `plumb correct` commands for poses of the model's tool in the base.
  static std::vector<Pose> corrected(const std::string& cell, const std::vector<Case>& targets) {
    std::ostringstream out;
    out.precision(17);
    out << "x_mm,y_mm,z_mm,qw,qx,qy,qz,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n";
    for (const Case& one : targets) {
      const Eigen::Quaterniond q(one.X_BT.linear());
      out << one.X_BT.translation()(0) << "," << one.X_BT.translation()(1) << ","
          << one.X_BT.translation()(2) << "," << q.w() << "," << q.x() << "," << q.y() << ","
          << q.z();
      for (const double joint : one.q) out << "," << joint;
      out << "\n";
    }
    box->write("expected.csv", out.str());
    const Ran ran = box->plumb({"correct", cell + "/robot.plumb", "--data", "expected.csv", "-o",
                                "expected_out.csv", "--force"});
    EXPECT_EQ(ran.exit, 0) << ran.err;
    const Csv csv = box->csv("expected_out.csv");
    std::vector<Pose> poses;
    for (std::size_t i = 0; i < csv.rows(); ++i) {
      const auto at = [&](const char* name) { return csv.numbers(name)[i]; };
      EXPECT_EQ(csv.columns.at("status")[i].find("not"), std::string::npos);
      Pose X = Pose::Identity();
      X.translation() = Eigen::Vector3d(at("cx_mm"), at("cy_mm"), at("cz_mm"));
      X.linear() =
          Eigen::Quaterniond(at("cqw"), at("cqx"), at("cqy"), at("cqz")).toRotationMatrix();
      poses.push_back(X);
    }
    return poses;
  }

  /// The numbers of a line behind this text.
  static std::vector<double> numbers_after(const std::string& text, const std::string& mark) {
    const std::size_t at = text.find(mark);
    EXPECT_NE(at, std::string::npos) << mark;
    if (at == std::string::npos) return std::vector<double>(12, 0.0);
    std::string rest = text.substr(at + mark.size(), 600);
    for (char& c : rest)
      if ((c < '0' || c > '9') && c != '.' && c != '-') c = ' ';
    std::istringstream in(rest);
    std::vector<double> out;
    for (std::string word; in >> word && out.size() < 12;)
      if (word != "-" && word != ".") out.push_back(std::strtod(word.c_str(), nullptr));
    out.resize(12);
    return out;
  }

  static std::string number(double value, int decimals) {
    char out[64];
    std::snprintf(out, sizeof out, "%.*f", decimals, value);
    return out;
  }

  /// A RAPID module whose targets are these, in a work object, for a tool.
  static std::string rapid(const std::vector<Case>& targets, const Pose& X_BW, const Pose& X_PT,
                           const std::string& tool, const std::string& work) {
    std::string out =
        "MODULE Weld\r\n  ! caf\xE9, 100 %\r\n  PERS tooldata tGun:=[TRUE,[" + tool +
        "],[1,[0,0,1],[1,0,0,0],0,0,0]];\r\n  PERS wobjdata wTable:=[FALSE,TRUE,\"\",[" + work +
        "],[[0,0,0],[1,0,0,0]]];\r\n";
    std::string moves;
    for (std::size_t i = 0; i < targets.size(); ++i) {
      const Pose X = X_BW.inverse() * targets[i].X_BT * X_PT.inverse();
      const Eigen::Quaterniond r(X.linear());
      const auto& q = targets[i].q;
      const std::string name = "p" + std::to_string(i);
      out += "  CONST robtarget " + name + ":=[[" + number(X.translation()(0), 3) + "," +
             number(X.translation()(1), 3) + "," + number(X.translation()(2), 3) + "],[" +
             number(r.w(), 9) + "," + number(r.x(), 9) + "," + number(r.y(), 9) + "," +
             number(r.z(), 9) + "],[";
      for (const int axis : {0, 3, 5})
        out += number(std::floor(q[static_cast<std::size_t>(axis)] / 90.0), 0) + ",";
      out += std::string(q[4] < 0.0 ? "1" : "0") + "],[9E9,9E9,9E9,9E9,9E9,9E9]];\r\n";
      moves += "    Move" + std::string(i == 0 ? "J " : "L ") + name +
               ",v100,fine,tGun\\WObj:=wTable;\r\n";
    }
    return out + "  PROC main()\r\n" + moves + "  ENDPROC\r\nENDMODULE\r\n";
  }

  static std::string urscript(const std::vector<Case>& read) {
    std::string text = "def job():\n  set_tcp(p[0,0,0.12,0,0,0])\n";
    for (std::size_t i = 0; i < read.size(); ++i) {
      const Eigen::AngleAxisd r(read[i].X_BT.linear());
      const Eigen::Vector3d p = read[i].X_BT.translation() * 1e-3, v = r.axis() * r.angle();
      const std::string n = std::to_string(i);
      text += "  W" + n + "_p=p[" + number(p(0), 7) + "," + number(p(1), 7) + "," +
              number(p(2), 7) + "," + number(v(0), 9) + "," + number(v(1), 9) + "," +
              number(v(2), 9) + "]\n  W" + n + "_q=[";
      for (std::size_t k = 0; k < 6; ++k) text += (k ? "," : "") + number(read[i].q[k] * kDeg, 4);
      text += "]\n  movej(get_inverse_kin(W" + n + "_p, qnear=W" + n + "_q), a=1.4, v=1.05)\n";
    }
    return text;
  }

  /// A Fanuc program whose positions are these, in a user frame; rounds them as it does. `joints`:
  /// before each it moves to joints beside it, because the configuration alone leaves several.
  static std::string fanuc(std::vector<Case>& read, const Pose& X_BW, bool joints) {
    std::string moves, positions;
    for (std::size_t i = 0; i < read.size(); ++i) {
      const Pose X = X_BW.inverse() * read[i].X_BT;
      const Eigen::Vector3d zyx = X.linear().eulerAngles(2, 1, 0) / kDeg;
      const std::string n = std::to_string(i + 1);
      if (joints) {
        moves += "   1:J P[10" + n + "] 100% FINE    ;\n";
        positions += "P[10" + n + "]{\n   GP1:\n\tUF : 1, UT : 1,\n";
        for (std::size_t k = 0; k < 6; ++k)
          positions += "\tJ" + std::to_string(k + 1) + "= " + number(read[i].q[k] + 1.0, 3) +
                       (k == 5 ? " deg\n};\n" : " deg,\n");
      }
      moves += "   " + n + ":" + (i == 0 ? "J" : "L") + " P[" + n + "] 100mm/sec FINE    ;\n";
      const Eigen::Vector3d p = X.translation();
      positions += "P[" + n + "]{\n   GP1:\n\tUF : 1, UT : 1,\t\tCONFIG : '" +
                   (read[i].q[4] < 0.0 ? "N" : "F") + " U T, 0, 0, 0',\n\tX = " + number(p(0), 3) +
                   "  mm,\tY = " + number(p(1), 3) + "  mm,\tZ = " + number(p(2), 3) +
                   "  mm,\n\tW = " + number(zyx(2), 3) + " deg,\tP = " + number(zyx(1), 3) +
                   " deg,\tR = " + number(zyx(0), 3) + " deg\n};\n";
      const auto round = [](double v) { return std::round(v * 1000.0) / 1000.0; };
      read[i].X_BT = X_BW * pose(round(p(0)), round(p(1)), round(p(2)), round(zyx(2)),
                                 round(zyx(1)), round(zyx(0)));
    }
    return "/PROG  PICK\n/MN\n" + moves + "/POS\n" + positions + "/END\n";
  }

  static Json program(const Ran& ran) { return ran.json().at("result").at("programs").at(0); }

  static Sandbox* box;
  static std::vector<Case>* cases;
};
Sandbox* FilterVerb::box = nullptr;
std::vector<Case>* FilterVerb::cases = nullptr;

const std::string kOwnTool = "[0,0,150],[1,0,0,0]";  // that of the cell
const std::string kNoFrame = "[0,0,0],[1,0,0,0]";

TEST_F(FilterVerb, RapidTargetsInAWorkObjectAreThoseOfCorrectToTheLastDigit) {
  const Pose X_BW = pose(300, -200, 100, 0, 0, 90);
  const Pose X_FP = pose(20, 0, 210, 0, 90, 0), X_FT = pose(0, 0, 150, 0, 0, 0);
  const Pose X_PT = X_FP.inverse() * X_FT;
  box->write("weld.mod", rapid(*cases, X_BW, X_PT, "[20,0,210],[0.70710678,0,0.70710678,0]",
                               "[300,-200,100],[0.70710678,0,0,0.70710678]"));
  const Ran ran = box->plumb({"-C", "cell", "filter", "weld.mod", "-o", "out", "--json"});
  ASSERT_EQ(ran.exit, 0) << ran.err << ran.out;
  const Json found = program(ran);
  EXPECT_EQ(found.at("targets"), cases->size());
  EXPECT_EQ(found.at("corrected"), cases->size()) << found.dump(1);
  EXPECT_GT(found.at("largest_mm").get<double>(), 0.3);
  EXPECT_TRUE(found.at("between_targets_mm").is_number());
  EXPECT_LE(found.at("rounding_mm").get<double>(), 0.001);
  EXPECT_NE(ran.out.find("W-FILTER-TOOL"), std::string::npos);
  const std::string before = box->read("weld.mod"), after = box->read("out/weld.mod");
  std::vector<Case> read = *cases;  // the targets as their digits say
  for (std::size_t i = 0; i < read.size(); ++i) {
    const auto n = numbers_after(before, "p" + std::to_string(i) + ":=[[");
    Pose X = Pose::Identity();
    X.translation() = Eigen::Vector3d(n[0], n[1], n[2]);
    X.linear() = Eigen::Quaterniond(n[3], n[4], n[5], n[6]).normalized().toRotationMatrix();
    read[i].X_BT = X_BW * X * X_PT;
  }
  const auto expected = corrected("cell", read);
  for (std::size_t i = 0; i < read.size(); ++i) {
    const auto n = numbers_after(after, "p" + std::to_string(i) + ":=[[");
    const Pose X = X_BW.inverse() * expected[i] * X_PT.inverse();
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(n[static_cast<std::size_t>(k)], X.translation()(k), 0.00051) << i;
  }
}

TEST_F(FilterVerb, FanucPositionsAreThoseOfCorrectWithFramesFromTheCommandLine) {
  const Pose X_BW = pose(100, 50, -20, 5, 10, 15);
  std::vector<Case> read = *cases;
  const std::string text = fanuc(read, X_BW, true);
  box->write("PICK.LS", text);
  const Ran none = box->plumb({"-C", "cell", "filter", "PICK.LS", "-o", "ls", "--json"});
  EXPECT_EQ(none.exit, 4);
  EXPECT_EQ(none.json().at("error").at("code"), "E-FILTER-NONE");
  EXPECT_NE(none.out.find("--tool 1=X,Y,Z,RX,RY,RZ or =model"), std::string::npos) << none.out;
  EXPECT_FALSE(std::filesystem::exists(box->path() / "ls"));
  const Ran ran = box->plumb({"-C", "cell", "filter", "PICK.LS", "-o", "ls", "--tool", "1=model",
                              "--frame", "1=100,50,-20,5,10,15", "--json"});
  ASSERT_EQ(ran.exit, 0) << ran.err << ran.out;
  EXPECT_EQ(program(ran).at("corrected"), read.size()) << ran.out;
  EXPECT_EQ(program(ran).at("joint_targets"), read.size()) << ran.out;
  std::vector<Case> same = *cases;
  box->write("FAR.LS", fanuc(same, X_BW, false));
  const Ran far = box->plumb({"-C", "cell", "filter", "FAR.LS", "-o", "ls", "--tool", "1=model",
                              "--frame", "1=100,50,-20,5,10,15", "--json"});
  EXPECT_EQ(far.exit, 4) << "where the arm was before the first move is not known";
  EXPECT_NE(far.out.find("--start"), std::string::npos);
  const auto expected = corrected("cell", read);
  const std::string after = box->read("ls/PICK.LS");
  EXPECT_NE(after.find("/MN\n   1:  !plumb filter: targets corrected ;\n"), std::string::npos);
  for (std::size_t i = 0; i < read.size(); ++i) {
    const std::size_t from = after.find("P[" + std::to_string(i + 1) + "]{");
    const auto n = numbers_after(after.substr(from), "\tX =");
    const Pose X = X_BW.inverse() * expected[i];
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(n[static_cast<std::size_t>(k)], X.translation()(k), 0.00051) << i;
  }
}

TEST_F(FilterVerb, KrlPositionsInTheDataFileAreThoseOfCorrect) {
  std::string moves, data = "DEFDAT job\nTOOL_DATA[1]={X 0,Y 0,Z 150,A 0,B 0,C 0}\n";
  std::vector<Case> read = *cases;
  for (std::size_t i = 0; i < read.size(); ++i) {
    const Eigen::Vector3d p = read[i].X_BT.translation();
    const Eigen::Vector3d abc = read[i].X_BT.linear().eulerAngles(2, 1, 0) / kDeg;
    int turn = 0;
    for (std::size_t k = 0; k < 6; ++k) turn |= read[i].q[k] < 0.0 ? 1 << k : 0;
    data += "DECL E6POS XP" + std::to_string(i) + "={X " + number(p(0), 4) + ",Y " +
            number(p(1), 4) + ",Z " + number(p(2), 4) + ",A " + number(abc(0), 4) + ",B " +
            number(abc(1), 4) + ",C " + number(abc(2), 4) + ",S 2,T " + std::to_string(turn) +
            ",E1 0.0}\n";
    moves += "PTP XP" + std::to_string(i) + "\n";
  }
  box->write("job.src", "DEF job( )\n$TOOL=TOOL_DATA[1]\n$BASE=$NULLFRAME\n" + moves + "END\n");
  box->write("job.dat", data + "ENDDAT\n");
  const Ran ran = box->plumb({"-C", "cell", "filter", "job.src", "-o", "krl", "--json"});
  ASSERT_EQ(ran.exit, 0) << ran.err << ran.out;
  const Json found = program(ran);
  EXPECT_EQ(found.at("corrected"), read.size()) << found.dump(1);
  EXPECT_TRUE(found.at("between_targets_mm").is_null());
  EXPECT_EQ(box->read("krl/job.src"), box->read("job.src")) << "nothing changes in it";
  const auto expected = corrected("cell", read);
  const std::string after = box->read("krl/job.dat");
  for (std::size_t i = 0; i < read.size(); ++i) {
    const auto n = numbers_after(after, "XP" + std::to_string(i) + "={X");
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(n[static_cast<std::size_t>(k)], expected[i].translation()(k), 0.0006) << i;
  }
}

TEST_F(FilterVerb, UrscriptPosesAreThoseOfCorrectFromTheJointsBesideThem) {
  ASSERT_EQ(box->plumb({"demo", "gear", "ur"}).exit, 0);
  ASSERT_EQ(box->plumb({"-C", "ur", "compile"}).exit, 0);
  std::vector<Case> read = cases_of("ur", false);
  const std::string text = urscript(read);
  box->write("job.script", text + "end\n");
  const Ran ran = box->plumb({"-C", "ur", "filter", "job.script", "-o", "urs", "--json"});
  ASSERT_EQ(ran.exit, 0) << ran.err << ran.out;
  const Json found = program(ran);
  EXPECT_EQ(found.at("corrected").get<std::size_t>() + found.at("untouched").size(), read.size());
  EXPECT_GT(found.at("corrected").get<std::size_t>(), read.size() / 2) << found.dump(1);
  EXPECT_EQ(found.at("joint_targets"), read.size());
  const auto expected = corrected("ur", read);
  const std::string after = box->read("urs/job.script");
  std::size_t same = 0;
  for (std::size_t i = 0; i < read.size(); ++i) {
    const auto n = numbers_after(after, "W" + std::to_string(i) + "_p=p[");
    const Eigen::Vector3d p(n[0], n[1], n[2]);
    same += (p * 1e3 - expected[i].translation()).cwiseAbs().maxCoeff() < 2e-4 ? 1U : 0U;
  }
  EXPECT_EQ(same, found.at("corrected").get<std::size_t>());
  box->write("joints.script", text + "  movej(W0_q, a=1.4, v=1.05)\nend\n");
  const Ran joints =
      box->plumb({"-C", "ur", "filter", "joints.script", "-o", "urj", "--joint-targets", "--json"});
  ASSERT_EQ(joints.exit, 0) << joints.err;
  EXPECT_EQ(program(joints).at("joint_targets"), 0);
  EXPECT_EQ(program(joints).at("corrected").get<int>(), found.at("corrected").get<int>() + 1);
  const auto before = numbers_after(text, "W0_q=[");
  const auto now = numbers_after(box->read("urj/joints.script"), "W0_q=[");
  double turned = 0.0;
  for (std::size_t k = 0; k < 6; ++k) turned = std::max(turned, std::abs(now[k] - before[k]));
  EXPECT_GT(turned, 1e-5);
  EXPECT_LT(turned, 0.02);
}

TEST_F(FilterVerb, AFilteredProgramSaysSoAndIsRefusedASecondTime) {
  box->write("once.mod", rapid(*cases, Pose::Identity(), Pose::Identity(), kOwnTool, kNoFrame));
  ASSERT_EQ(box->plumb({"-C", "cell", "filter", "once.mod", "-o", "first"}).exit, 0);
  const std::string after = box->read("first/once.mod");
  EXPECT_NE(after.find("MODULE Weld\r\n! plumb filter: targets corrected\r\n! model "),
            std::string::npos);
  const Ran again =
      box->plumb({"-C", "cell", "filter", "first/once.mod", "-o", "second", "--json"});
  EXPECT_EQ(again.exit, 3);
  const Json error = again.json().at("error");
  EXPECT_EQ(error.at("code"), "E-FILTER-TWICE");
  EXPECT_NE(again.json().dump().find("first/once.mod"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(box->path() / "second"));
}

TEST_F(FilterVerb, WithAModelThatCorrectsNothingTheBytesAreTheSame) {
  ASSERT_EQ(box->plumb({"demo", "compliance", "nominal"}).exit, 0);
  const std::string targets = rapid(*cases, Pose::Identity(), Pose::Identity(), kOwnTool, kNoFrame);
  std::string cell = box->read("nominal/cell.toml");
  const std::size_t at = cell.find("geometry = true");
  ASSERT_NE(at, std::string::npos);
  cell.replace(at, 15, "geometry = false");
  box->write("nominal/cell.toml", cell);
  ASSERT_EQ(box->plumb({"-C", "nominal", "compile"}).exit, 0);
  box->write("same.mod", targets);
  const Ran ran = box->plumb({"-C", "nominal", "filter", "same.mod", "-o", "same"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_EQ(box->read("same/same.mod"), targets);
  EXPECT_NE(ran.out.find("byte for byte"), std::string::npos) << ran.out;
  std::filesystem::copy(PLUMB_SOURCES "/tests/programs/corpus", box->path() / "corpus");
  for (const std::string file : {"traps.mod", "TRAPS.LS", "traps.src"}) {
    const Ran one =
        box->plumb({"-C", "nominal", "filter", "corpus/" + file, "-o", "same", "--tool", "1=model",
                    "--frame", "1=0,0,0,0,0,0", "--start", "0,25,85,0,70,-175", "--json"});
    EXPECT_EQ(one.exit, 0) << file << one.err;
    EXPECT_GE(program(one).at("corrected").get<int>(), 4) << file;
    EXPECT_EQ(program(one).at("changed"), 0) << file;
    EXPECT_EQ(box->read("same/" + file), box->read("corpus/" + file));
  }
  EXPECT_EQ(box->read("same/traps.dat"), box->read("corpus/traps.dat"));
}

TEST_F(FilterVerb, BetweenTargetsTheErrorIsThatOfTheStraightLineAgainstCorrect) {
  std::vector<Case> ends{(*cases)[0], (*cases)[0]};
  ends[1].X_BT.translation() += Eigen::Vector3d(-700, 500, 200);
  box->write("LINE.LS", fanuc(ends, Pose::Identity(), false));
  std::string start = "--start=";
  for (std::size_t j = 0; j < 6; ++j) start += (j ? "," : "") + number(ends[0].q[j], 6);
  const Ran ran = box->plumb({"-C", "cell", "filter", "LINE.LS", "-o", "line", "--tool", "1=model",
                              "--frame", "1=0,0,0,0,0,0", start, "--json"});
  ASSERT_EQ(ran.exit, 0) << ran.err << ran.out;
  ASSERT_EQ(program(ran).at("corrected"), 2) << ran.out;
  const std::string after = box->read("line/LINE.LS");
  std::vector<Eigen::Vector3d> written;
  for (const char* const mark : {"P[1]{", "P[2]{"}) {
    const auto n = numbers_after(after.substr(after.find(mark)), "\tX =");
    written.emplace_back(n[0], n[1], n[2]);
  }
  const Eigen::Quaterniond q(ends[0].X_BT.linear());
  std::ostringstream line;
  line.precision(17);
  line << "x_mm,y_mm,z_mm,qw,qx,qy,qz\n";
  constexpr int kPoints = 200;
  for (int k = 0; k <= kPoints; ++k) {
    const Eigen::Vector3d p =
        ends[0].X_BT.translation() +
        (ends[1].X_BT.translation() - ends[0].X_BT.translation()) * k / kPoints;
    line << p(0) << "," << p(1) << "," << p(2) << "," << q.w() << "," << q.x() << "," << q.y()
         << "," << q.z() << "\n";
  }
  box->write("line.csv", line.str());
  ASSERT_EQ(
      box->plumb({"correct", "cell/robot.plumb", "--data", "line.csv", start, "-o", "line_out.csv"})
          .exit,
      0);
  const Csv csv = box->csv("line_out.csv");
  double largest = 0.0;
  for (int k = 0; k <= kPoints; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const Eigen::Vector3d needed(csv.numbers("cx_mm")[i], csv.numbers("cy_mm")[i],
                                 csv.numbers("cz_mm")[i]);
    largest =
        std::max(largest, (written[0] + (written[1] - written[0]) * k / kPoints - needed).norm());
  }
  std::printf("between targets: %.4f mm\n", largest);
  EXPECT_GT(largest, 0.002);
  EXPECT_NEAR(program(ran).at("between_targets_mm").get<double>(), largest, 0.02 * largest + 5e-4);
}

TEST_F(FilterVerb, ADryRunShowsADiffThatCanBeAppliedAndWritesNothing) {
  std::string own = rapid(*cases, Pose::Identity(), Pose::Identity(), kOwnTool, kNoFrame);
  own.replace(own.find('\xE9'), 1, "e");  // a terminal shows ASCII as it is
  box->write("dry.mod", own);
  const auto before = box->listing();
  const Ran ran = box->plumb({"-C", "cell", "filter", "dry.mod", "-o", "dry", "--dry-run"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_EQ(box->listing(), before);
  EXPECT_NE(ran.out.find("\n--- dry.mod\n+++ dry.mod\n@@ -1,"), std::string::npos) << ran.out;
  EXPECT_NE(ran.out.find("\n-  CONST robtarget p0:=[["), std::string::npos);
  EXPECT_NE(ran.out.find("\n+  CONST robtarget p0:=[["), std::string::npos);
  const Ran json =
      box->plumb({"-C", "cell", "filter", "dry.mod", "-o", "dry", "--dry-run", "--json"});
  EXPECT_EQ(json.json().at("result").at("dry_run"), true);
  EXPECT_NE(program(json).at("diff").get<std::string>().find("+++ dry.mod"), std::string::npos);
  ASSERT_EQ(box->plumb({"-C", "cell", "filter", "dry.mod", "-o", "wet"}).exit, 0);
  EXPECT_EQ(applied(without_returns(box->read("dry.mod")), ran.out.substr(ran.out.find("--- dry"))),
            without_returns(box->read("wet/dry.mod")));
}

TEST_F(FilterVerb, NothingIsReplacedThatWasNotMeantAndNeverWhatIsRead) {
  box->write("keep.mod", rapid(*cases, Pose::Identity(), Pose::Identity(), kOwnTool, kNoFrame));
  const std::string own = box->read("keep.mod");
  const Ran onto = box->plumb({"-C", "cell", "filter", "keep.mod", "-o", ".", "--force", "--json"});
  EXPECT_EQ(onto.exit, 2);
  EXPECT_EQ(onto.json().at("error").at("code"), "E-OUTPUT-INPUT");
  EXPECT_EQ(box->read("keep.mod"), own);
  ASSERT_EQ(box->plumb({"-C", "cell", "filter", "keep.mod", "-o", "kept"}).exit, 0);
  const Ran twice = box->plumb({"-C", "cell", "filter", "keep.mod", "-o", "kept", "--json"});
  EXPECT_EQ(twice.exit, 2);
  EXPECT_EQ(twice.json().at("error").at("code"), "E-EXISTS");
  EXPECT_EQ(box->plumb({"-C", "cell", "filter", "keep.mod", "-o", "kept", "--force"}).exit, 0);
}

TEST_F(FilterVerb, FewDigitsAreSaidAndMoreAreWrittenIfAsked) {
  std::string text = rapid(*cases, Pose::Identity(), Pose::Identity(), kOwnTool, kNoFrame);
  for (std::size_t i = 0; i < cases->size(); ++i) {  // tenths of a millimetre
    const std::string mark = "p" + std::to_string(i) + ":=[[";
    const auto n = numbers_after(text, mark);
    const std::size_t from = text.find(mark) + mark.size();
    text.replace(from, text.find(']', from) - from,
                 number(n[0], 1) + "," + number(n[1], 1) + "," + number(n[2], 1));
  }
  box->write("tenths.mod", text);
  const Ran ran = box->plumb({"-C", "cell", "filter", "tenths.mod", "-o", "tenths", "--json"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const double rounding = program(ran).at("rounding_mm").get<double>();
  EXPECT_GT(rounding, 0.01);
  EXPECT_LT(rounding, 0.087);
  EXPECT_NE(ran.out.find("N-FILTER-DIGITS"), std::string::npos);
  const Ran more =
      box->plumb({"-C", "cell", "filter", "tenths.mod", "-o", "more", "--decimals", "4", "--json"});
  ASSERT_EQ(more.exit, 0) << more.err;
  EXPECT_LT(program(more).at("rounding_mm").get<double>(), 1e-4);
  EXPECT_EQ(more.out.find("N-FILTER-DIGITS"), std::string::npos);
}

TEST_F(FilterVerb, AToolThatChangesIsNotReplacedFromTheCommandLineNorOfferedForIt) {
  std::string text = rapid(*cases, Pose::Identity(), Pose::Identity(), kOwnTool, kNoFrame);
  const auto filtered = [&](const std::string& changed) {
    box->write("moving.mod", changed);
    return box->plumb({"-C", "cell", "filter", "moving.mod", "-o", "moving", "--tool", "tGun=model",
                       "--frame", "wTable=0,0,0,0,0,0", "--dry-run", "--json"});
  };
  EXPECT_EQ(filtered(text).exit, 0);
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string out = text;
    return out.replace(out.find(from), from.size(), to);
  };
  for (const std::string& changed :
       {with("PROC main()", "PROC main()\r\ntGun.tframe.trans.x:=7;"),
        with("PROC main()", "PROC main()\r\nwTable:=wOld;"),
        with("PROC main()", "PROC main()\r\nSetDataVal name,tOld;"),
        with("tGun:=[TRUE", "tGun:=[FALSE"), with("[FALSE,TRUE,", "[TRUE,TRUE,"),
        with("[FALSE,TRUE,", "[FALSE,FALSE,")}) {
    const Ran ran = filtered(changed);
    EXPECT_EQ(ran.exit, 4) << changed;
    EXPECT_EQ(ran.out.find("--tool tgun"), std::string::npos) << ran.out;
    EXPECT_EQ(ran.out.find("--frame wtable"), std::string::npos) << ran.out;
  }
  std::string other = with("tooldata tGun:=[TRUE,[[0,0,150]", "tooldata tGun:=[TRUE,[[0,0,where]");
  EXPECT_EQ(filtered(other).exit, 0) << "one that is only not stated as numbers is";
}

TEST_F(FilterVerb, TargetsWithExternalAxesAreListedUnlessTheRobotStands) {
  std::string text = rapid(*cases, Pose::Identity(), Pose::Identity(), kOwnTool, kNoFrame);
  text.replace(text.find("[9E9,"), 5, "[250,");
  box->write("rail.mod", text);
  const Ran ran = box->plumb({"-C", "cell", "filter", "rail.mod", "-o", "rail", "--json"});
  EXPECT_EQ(program(ran).at("corrected").get<std::size_t>(), cases->size() - 1);
  EXPECT_NE(ran.out.find("--robot-stands"), std::string::npos) << ran.out;
  const Ran stands =
      box->plumb({"-C", "cell", "filter", "rail.mod", "-o", "stands", "--robot-stands", "--json"});
  EXPECT_EQ(program(stands).at("corrected"), cases->size());
}

/// Behind a target that is not known, the nearest joints would be those beside another one.
TEST_F(FilterVerb, WhereTheArmWasIsForgottenBehindATargetThatIsNotKnown) {
  std::vector<Case> ends{(*cases)[0], (*cases)[0]};
  ends[1].X_BT.translation() += Eigen::Vector3d(0, 0, 20);
  std::string text = rapid(ends, Pose::Identity(), Pose::Identity(), kOwnTool, kNoFrame);
  text.replace(text.find("PROC main()"), 11, "PROC main()\r\n ConfL \\Off;");
  const auto count = [&](const std::string& program_text) {
    box->write("stale.mod", program_text);
    return program(
               box->plumb({"-C", "cell", "filter", "stale.mod", "-o", "x", "--dry-run", "--json"}))
        .at("corrected")
        .get<int>();
  };
  EXPECT_EQ(count(text), 2);
  const std::size_t second = text.find("    MoveL p1");
  EXPECT_EQ(count(std::string(text).insert(second, "MoveL pElsewhere,v100,fine,tGun;\r\n")), 1);
  EXPECT_EQ(count(std::string(text).insert(second, "MoveL Offs(p0,0,0,5),v100,fine,tGun;\r\n")), 1);
}

/// The same pose with one wrist and with the other: their corrections differ by millimetres.
TEST_F(FilterVerb, ATargetThatIsReachedInTwoWaysIsListed) {
  const auto why = [](const std::string& name, const std::string& text) {
    box->write(name, text);
    const Ran ran = box->plumb({"-C", "cell", "filter", name, "--tool", "1=model", "--frame",
                                "0=0,0,0,0,0,0", "--dry-run", "--json"});
    std::string out;
    const Json untouched = program(ran).at("untouched");
    for (const auto& one : untouched) out += one["why"].get<std::string>() + "\n";
    return out;
  };
  const std::string other_wrist =
      "movej(get_inverse_kin(W_p,qnear=[0.139626,0.314159,1.082104,-2.792527,-0.907571,-2.617994]))"
      "\n";
  const std::string script =
      "def prog():\nset_tcp(p[0,0,0.15,0,0,0])\n"
      "global W_p=p[1.583209,0.370682,1.468158,0.520189,2.274424,0.783132]\n"
      "movej(get_inverse_kin(W_p,qnear=[0.139626,0.314159,1.082104,0.349066,0.907571,0.523599]))\n";
  EXPECT_EQ(why("once.script", script + "end\n"), "");
  EXPECT_EQ(why("twice.script", script + other_wrist + "end\n"),
            "moves reach it with different joint positions\n");
  const auto fanuc = [](const std::string& side) {
    const auto pose = [](int number, const std::string& word) {
      return "P[" + std::to_string(number) + "]{\n   GP1:\n\tUF : 0, UT : 1,\tCONFIG : '" + word +
             " U T, 0, 0, 0',\n\tX = 1583.209 mm, Y = 370.682 mm, Z = 1468.158 mm,\n"
             "\tW = 132.334 deg, P = 27.512 deg, R = 141.890 deg\n};\n";
    };
    return "/PROG X\n/MN\n 1:J P[1] 50% FINE ;\n 2:J P[2] 50% FINE ;\n 3:J P[3] 50% FINE ;\n"
           "/POS\nP[1]{\n   GP1:\n\tUF : 0, UT : 1,\n\tJ1= 8 deg, J2= 18 deg, J3= 62 deg,\n"
           "\tJ4= 20 deg, J5= 52 deg, J6= 30 deg\n};\n" +
           pose(2, "N") + pose(3, side) + "/END\n";
  };
  EXPECT_EQ(why("same.ls", fanuc("N")), "");
  EXPECT_EQ(why("both.ls", fanuc("F")),
            "the wrist that was found for it contradicts 'F' of other targets\n");
}

TEST_F(FilterVerb, AFileInThePlaceOfTheFolderIsSaidBeforeAnythingElse) {
  box->write("folder.mod", rapid(*cases, Pose::Identity(), Pose::Identity(), kOwnTool, kNoFrame));
  box->write("taken", "x");
  for (const std::string folder : {"taken", "taken/deeper"})
    for (const std::string dry : {"--force", "--dry-run"}) {
      const Ran ran = box->plumb({"-C", "cell", "filter", "folder.mod", "-o", folder, dry});
      EXPECT_EQ(ran.exit, 2) << ran.err;
      EXPECT_EQ(ran.out, "");
      EXPECT_NE(ran.err.find("taken is a file, and a folder is meant"), std::string::npos)
          << ran.err;
    }
  EXPECT_EQ(box->read("taken"), "x");
}

TEST_F(FilterVerb, AFileInWhichNothingIsFoundGetsAWarning) {
  std::string returns = rapid(*cases, Pose::Identity(), Pose::Identity(), kOwnTool, kNoFrame);
  std::erase(returns, '\n');  // "! caf" then hides all that follows
  for (const std::string& text : {std::string("\x01\x02 noise"), std::string(), returns}) {
    box->write("noise.mod", text);
    const Ran ran = box->plumb({"-C", "cell", "filter", "noise.mod", "-o", "noise", "--force"});
    EXPECT_EQ(ran.exit, 0) << ran.err;
    EXPECT_NE(ran.err.find("W-FILTER-EMPTY"), std::string::npos) << ran.err;
    EXPECT_EQ(box->read("noise/noise.mod"), text);
  }
}

TEST_F(FilterVerb, WhatIsNotTouchedIsListedWithItsLine) {
  const std::string corpus = PLUMB_SOURCES "/tests/programs/corpus/traps.mod";
  std::filesystem::copy_file(corpus, box->path() / "traps.mod");
  const Ran ran = box->plumb({"-C", "cell", "filter", "traps.mod", "-o", "traps", "--json"});
  ASSERT_EQ(ran.exit, 0) << ran.err << ran.out;
  EXPECT_EQ(program(ran).at("corrected"), 4);
  const std::string before = box->read("traps.mod"), after = box->read("traps/traps.mod");
  for (const std::string& line : lines_of_text(before)) {
    if (line.find("trap") == std::string::npos) continue;
    EXPECT_NE(after.find(line + "\n"), std::string::npos) << line;
  }
  EXPECT_EQ(after.find("good1:=[[1400,"), std::string::npos) << "it is corrected";
  EXPECT_GE(program(ran).at("untouched").size(), 20U);
  for (const Json& one : program(ran).at("untouched")) EXPECT_GT(one.at("line").get<int>(), 0);
}

TEST_F(FilterVerb, TheExampleOfTheDocumentIsTrue) {
  std::ifstream in(PLUMB_SOURCES "/docs/filter.md");
  std::vector<std::string> blocks;  // what stands between the fences
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("```", 0) == 0) {
      inside = !inside;
      if (inside) blocks.emplace_back();
    } else if (inside) {
      blocks.back() += line + "\n";
    }
  }
  ASSERT_EQ(blocks.size(), 3U);
  box->write("weld.mod", blocks[0]);
  const Ran ran = box->plumb({"-C", "cell", "filter", "weld.mod", "-o", "example"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  for (const std::string& line : lines_of_text(blocks[1]))
    EXPECT_NE(ran.out.find(line + "\n"), std::string::npos) << line << "\n" << ran.out;
  for (const std::string& line : lines_of_text(blocks[2]))
    EXPECT_NE(box->read("example/weld.mod").find(line + "\n"), std::string::npos) << line;
}

TEST_F(FilterVerb, MistakesAreNamedWithTheirRemedy) {
  box->write("weld.tp", "x");
  const Ran language = box->plumb({"-C", "cell", "filter", "weld.tp", "--json"});
  EXPECT_EQ(language.exit, 3);
  EXPECT_EQ(language.json().at("error").at("code"), "E-FILTER-LANGUAGE");
  box->write("binary.ls", std::string("/PROG\0x", 7));
  EXPECT_EQ(box->plumb({"-C", "cell", "filter", "binary.ls"}).exit, 3);
  box->write("ok.mod", rapid(*cases, Pose::Identity(), Pose::Identity(), kOwnTool, kNoFrame));
  for (const auto& words : std::vector<std::vector<std::string>>{{"--tool", "tGun"},
                                                                 {"--tool", "tGun=1,2,3"},
                                                                 {"--frame", "w=model"},
                                                                 {"--start", "1,2"},
                                                                 {"--decimals", "-1"},
                                                                 {"--tool", "=0,0,0,0,0,0"}}) {
    std::vector<std::string> all{"-C", "cell", "filter", "ok.mod", "-o", "bad", "--json"};
    all.insert(all.end(), words.begin(), words.end());
    const Ran ran = box->plumb(all);
    EXPECT_EQ(ran.exit, 2) << words[0] << " " << words[1];
    EXPECT_EQ(ran.json().at("error").at("code"), "E-USAGE") << words[1];
  }
  EXPECT_EQ(box->plumb({"-C", "cell", "filter", "missing.mod"}).exit, 3);
  EXPECT_EQ(box->plumb({"-C", "cell", "filter"}).exit, 2);
  std::filesystem::create_directory(box->path() / "other");
  box->write("other/ok.mod", "MODULE m\nENDMODULE\n");
  const Ran same = box->plumb({"-C", "cell", "filter", "ok.mod", "other/ok.mod", "-o", "two"});
  EXPECT_EQ(same.exit, 2);
  EXPECT_NE(same.err.find("two programs would be written to two/ok.mod"), std::string::npos);
  box->write("empty.mod", "MODULE m\nENDMODULE\n");
  box->write("tool.mod",
             "MODULE Tool\n  PERS tooldata tFar:=[TRUE,[[0,0,150],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],"
             "0,0,0]];\nENDMODULE\n");
  std::string apart = box->read("ok.mod");
  apart.replace(apart.find("tooldata tGun"), 13, "tooldata tOld");
  for (std::size_t at; (at = apart.find("tGun")) != std::string::npos;)
    apart.replace(at, 4, "tFar");
  box->write("apart.mod", apart);
  EXPECT_EQ(box->plumb({"-C", "cell", "filter", "apart.mod", "-o", "one"}).exit, 4);
  EXPECT_EQ(box->plumb({"-C", "cell", "filter", "apart.mod", "tool.mod", "-o", "one"}).exit, 0)
      << "a tool may stand in another program";
  const Ran empty = box->plumb({"-C", "cell", "filter", "empty.mod", "-o", "empty"});
  EXPECT_EQ(empty.exit, 0) << empty.err;
  EXPECT_EQ(box->read("empty/empty.mod"), "MODULE m\nENDMODULE\n");
}

}  // namespace
