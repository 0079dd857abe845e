// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "cell/measurements.hpp"
#include "import/column_guess.hpp"
#include "import/completeness.hpp"
#include "import/importer.hpp"
#include "import/timestamps.hpp"
#include "import/words.hpp"
#include "tests/import/imported_text.hpp"
#include "tests/import/temporary_file.hpp"

namespace plumb::offline {
namespace {

using tests::TemporaryFolder;

Imported imported(const std::string& bytes, const ImportWishes& wishes = {}) {
  const TemporaryFolder folder;
  return import_file(folder.put("log.txt", bytes), wishes);
}

Problem refused(const std::string& bytes, const ImportWishes& wishes = {}) {
  try {
    (void)imported(bytes, wishes);
  } catch (const Failure& f) {
    return f.problems().front();
  }
  return {.code = "accepted"};
}

const Problem* remark(const Imported& data, const std::string& code) {
  for (const auto& problem : data.remarks)
    if (problem.code == code) return &problem;
  return nullptr;
}

ImportWishes mapped(const std::string& map) {
  ImportWishes out;
  out.map = {map};
  return out;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

/// What stands between the quotes of --map "...".
std::string offered(const Problem& problem) {
  const auto first = problem.help.find("--map \"") + 7;
  return problem.help.substr(first, problem.help.find('"', first) - first);
}

TEST(Words, OfSixLanguagesMeanTheSameColumns) {
  const std::vector<std::pair<std::string, std::string>> kCases{{"X-Koordinate", "x"},
                                                                {"Y-KOORDINATE", "y"},
                                                                {"Koordinate Z", "z"},
                                                                {"Punktname", "pose"},
                                                                {"Punkt", "pose"},
                                                                {"Zeitstempel", "time"},
                                                                {"Traglast", "payload"},
                                                                {"Gelenk 1", "q1"},
                                                                {"Achse 6", "q6"},
                                                                {"Temperatur", "temp"},
                                                                {"Bemerkung", "note"},
                                                                {"Standardabweichung X", "sx"},
                                                                {"Coordonnée X", "x"},
                                                                {"Température", "temp"},
                                                                {"Écart-type Y", "sy"},
                                                                {"Axe 2", "q2"},
                                                                {"Articulation 3", "q3"},
                                                                {"Horodatage", "time"},
                                                                {"Coordinata Z", "z"},
                                                                {"Giunto 4", "q4"},
                                                                {"Carico", "payload"},
                                                                {"Asse 5", "q5"},
                                                                {"Articulación 1", "q1"},
                                                                {"Eje 2", "q2"},
                                                                {"Coordenada X", "x"},
                                                                {"Punto", "pose"},
                                                                {"X座標", "x"},
                                                                {"第1軸", "q1"},
                                                                {"関節2", "q2"},
                                                                {"温度", "temp"},
                                                                {"坐标X", "x"},
                                                                {"关节3", "q3"},
                                                                {"时间", "time"},
                                                                {"Joint 1", "q1"},
                                                                {"actual_q_2", "q2"},
                                                                {"target_q_2", "qc2"},
                                                                {"Soll X", "nx"},
                                                                {"pose.position.x", "x"},
                                                                {"pose.orientation.w", "qw"},
                                                                {"Measured X", "x"},
                                                                {"measurement_std_x", "sx"}};
  for (const auto& [header, name] : kCases) EXPECT_EQ(named_column(header).name, name) << header;
  for (const char* other : {"J1 current", "J1 [A]", "X error", "dX", "Index", "A1 Moment", "Goal x",
                            "max", "X velocity", "", "%&/"})
    EXPECT_EQ(named_column(other).name, "") << other;
}

TEST(Import, FourColumnsOfUnitLengthAreAQuaternionAndNoJoints) {
  const std::string rows = "1,10,0.6,0.8,0,0,5\n2,20,0.5,0.5,0.5,0.5,6\n";
  const Imported first = imported("J1_deg,J2_deg,Q0,Q1,Q2,Q3,x_mm\n" + rows);
  EXPECT_EQ(first.find("qw")->text[0], "0.6");
  EXPECT_EQ(first.find("qx")->text[0], "0.8");
  EXPECT_EQ(first.find("q1")->text[1], "2");
  EXPECT_NE(remark(first, "N-IMPORT-QUAT"), nullptr);
  const Imported unclear = imported("J1_deg,J2_deg,Q1,Q2,Q3,Q4,x_mm\n" + rows);
  EXPECT_EQ(unclear.find("qw"), nullptr);
  EXPECT_EQ(unclear.find("q3"), nullptr);
  const Problem* asked = remark(unclear, "W-IMPORT-QUAT");
  ASSERT_NE(asked, nullptr);
  const Imported told =
      imported("J1_deg,J2_deg,Q1,Q2,Q3,Q4,x_mm\n" + rows, mapped(offered(*asked)));
  EXPECT_EQ(told.find("qw")->text[0], "0.6");
  const Imported joints = imported("Q1_rad,Q2_rad,Q3_rad,Q4_rad,x_mm\n0.6,0.8,0,0,1\n");
  EXPECT_EQ(joints.find("q4")->unit, "rad");
  const Imported beside =
      imported("J1_deg,J2_deg,J3_deg,Q1,Q2,Q3,x_mm\n1,2,3,0.1,0.2,0.3,5\n4,5,6,0.1,0.1,0.3,5\n");
  EXPECT_EQ(beside.find("q3")->from, "J3_deg");
  EXPECT_NE(remark(beside, "W-IMPORT-QUAT"), nullptr);
}

TEST(Import, JointsCountedFromZeroAreCountedFromOneAndSaid) {
  const Imported data =
      imported("actual_q_0 [rad],actual_q_1 [rad],actual_q_2 [rad],x_mm\n1,2,3,4\n5,6,7,8\n");
  EXPECT_EQ(data.find("q1")->text[0], "1");
  EXPECT_EQ(data.find("q3")->text[0], "3");
  EXPECT_NE(remark(data, "N-IMPORT-ZERO"), nullptr);
}

TEST(Import, OffersTheUnitsThatTheSizesOfTheNumbersAllow) {
  const auto help = [](const std::string& bytes) { return offered(refused(bytes)); };
  EXPECT_EQ(help("q1_deg,x,y\n1,1250.5,3\n2,900,1\n"), "x=x_mm,y=y_mm");
  EXPECT_EQ(help("q1_deg,x,y\n1,1.2505,0.3\n2,0.9,1\n"), "x=x_m,y=y_m");
  EXPECT_EQ(help("q1_deg,x_mm,sx\n1,1250.5,0.012\n2,900,0.01\n"), "sx=sx_mm");
  EXPECT_EQ(help("q1_deg,x_mm,sx\n1,1250.5,12\n2,900,14\n"), "sx=sx_um");
  EXPECT_EQ(help("q1_deg,x_mm,sx\n1,1250.5,1.2\n2,900,1.4\n"), "sx=sx_um|mm");
  EXPECT_EQ(help("q1,q2,x_mm\n1,170,5\n2,-90,6\n"), "q1=q1_deg,q2=q2_deg");
  EXPECT_EQ(help("q1,q2,x_mm\n1,3.1,5\n2,-1,6\n"), "q1=q1_deg|rad,q2=q2_deg|rad");
  EXPECT_EQ(help("q1,q2_rad,x_mm\n1,3.1,5\n2,-1,6\n"), "q1=q1_rad");
  EXPECT_EQ(help("q1_deg,x_mm,Temp\n1,5,21.5\n2,6,22\n"), "Temp=temp_degC");
  EXPECT_EQ(help("q1_deg,x_mm,Temp\n1,5,293\n2,6,294\n"), "Temp=temp_K");
}

TEST(Import, OneLineToPasteDecidesAllColumns) {
  const std::string bytes =
      "Achse 1;Achse 2;X, gemessen;Y;Traglast\n10;170;1250,5;3,5;5\n2;3;4,5;5;6\n";
  const Problem asked = refused(bytes);
  EXPECT_EQ(asked.code, "E-IMPORT-UNIT");
  EXPECT_EQ(offered(asked),
            "Achse 1=q1_deg,Achse 2=q2_deg,X, gemessen=x_mm,Y=y_mm,Traglast=payload_kg");
  const Imported data = imported(bytes, mapped(offered(asked)));
  EXPECT_EQ(data.find("x")->text[0], "1250.5");
  EXPECT_EQ(data.find("payload")->unit, "kg");
  EXPECT_EQ(refused("q1,x_mm\n1,5\n2,6\n", mapped("q1=q1_deg|rad")).code, "E-IMPORT-MAP");
}

TEST(Import, SeparatorsAtTheEndOfLinesAndEmptyLastCellsAreNoRaggedRows) {
  for (const char* bytes : {"q1_deg;x_mm\n1;2;\n3;4;\n", "q1_deg;x_mm;\n1;2\n3;4\n",
                            "q1_deg;x_mm;;\n1;2;;\n3;4;;\n", "q1_deg;x_mm;\n1;2;\n3;4\n"}) {
    const Imported data = imported(bytes);
    EXPECT_EQ(tests::texts_of(*data.find("x")), (std::vector<std::string>{"2", "4"})) << bytes;
    EXPECT_NE(remark(data, "N-IMPORT-EMPTY"), nullptr) << bytes;
  }
  const Imported notes = imported("q1_deg;x_mm;note\n1;2;\n3;4;good\n");
  EXPECT_EQ(tests::texts_of(*notes.find("note")), (std::vector<std::string>{"", "good"}));
  EXPECT_EQ(refused("q1_deg;x_mm\n1;2;\n3;4;5\n").code, "E-IMPORT-RAGGED");
}

TEST(Import, AnEmptyColumnIsLeftOutAndAGapIsNot) {
  EXPECT_EQ(imported("q1_deg;x_mm;y_mm\n1;2;\n3;4;\n").find("y"), nullptr);
  EXPECT_EQ(refused("q1_deg;x_mm;y_mm\n1;2;3\n3;4;\n").code, "E-IMPORT-NUMBER");
}

TEST(Import, APointBesideDecimalCommasNeverTurnsIntoAnotherNumber) {
  EXPECT_EQ(refused("q1_deg;x_mm\n1,5;0.125\n2,5;1.5\n").code, "E-IMPORT-NUMBER");
  EXPECT_EQ(refused("q1_deg;x_mm\n1,5;10.125\n2,5;20.250\n").code, "E-IMPORT-DECIMAL");
  EXPECT_EQ(imported("q1_deg;x_mm\n1,5;1.234.567,8\n").find("x")->text[0], "1234567.8");
  EXPECT_EQ(imported("q1_deg,x_mm\n\"1,5\",\"2,25\"\n\"3,5\",\"4,25\"\n").find("x")->text[0],
            "2.25");
}

TEST(Import, ASeparatorBetweenBracketsOfAHeadingDividesNoColumns) {
  for (const char separator : {';', ','}) {
    const std::string s(1, separator);
    const Imported data = imported("q1_deg" + s + "U(x) [mm" + s + " k=2]" + s + "x_mm\n1" + s +
                                   "0.024" + s + "2.5\n2" + s + "0.024" + s + "3.5\n");
    ASSERT_NE(data.find("sx"), nullptr) << separator;
    EXPECT_EQ(data.find("sx")->text[0], "0.012") << separator;
    ASSERT_NE(data.find("x"), nullptr) << separator;
    EXPECT_EQ(data.find("x")->text[1], "3.5") << separator;
  }
}

TEST(Import, ExpandedUncertaintiesAreDividedByTheirFactorAndSaid) {
  for (const char* header : {"U(95) X [mm]",
                             "U95 X (mm)",
                             "U95_X_mm",
                             "Uncertainty X (k=2) [mm]",
                             "Messunsicherheit X (k = 2) / mm",
                             "expanded uncertainty X (mm)",
                             "X 2 sigma [mm]",
                             "u95 x mm",
                             "X U(95) [mm]",
                             "Ux [mm] (k=2)",
                             "Ux (k=2) [mm]",
                             "Ux (mm) (k = 2)",
                             "(k=2) Ux [mm]",
                             "[mm] Ux (k=2)",
                             "Ux_mm (k=2)",
                             "U_X mm k=2",
                             "Messunsicherheit X [mm] (k=2)",
                             "U(x) [mm, k=2]",
                             "Ux [mm,K=2]",
                             "Ux (mm; k = 2)",
                             "Ux [k=2, mm]",
                             "U(X) [mm; k=2,0]"}) {
    const Imported data = imported(std::string("q1_deg\tx_mm\t") + header + "\n1\t2\t0.024\n");
    ASSERT_NE(data.find("sx"), nullptr) << header;
    EXPECT_EQ(data.find("sx")->text[0], "0.012") << header;
    EXPECT_NE(remark(data, "N-IMPORT-EXPANDED"), nullptr) << header;
  }
  EXPECT_EQ(imported("q1_deg\tx_mm\t3 sigma X [mm]\n1\t2\t0.03\n").find("sx")->text[0], "0.01");
  EXPECT_EQ(imported("q1_deg\tx_mm\tsx_mm\n1\t2\t0.024\n").find("sx")->text[0], "0.024");
  for (const char* header : {"Uncertainty X [mm]", "U(95) [mm]", "Messunsicherheit"}) {
    const Imported unclear = imported(std::string("q1_deg\tx_mm\t") + header + "\n1\t2\t0.024\n");
    EXPECT_EQ(unclear.find("sx"), nullptr) << header;
    EXPECT_NE(remark(unclear, "W-IMPORT-UNCERTAINTY"), nullptr) << header;
  }
  const auto help = [](const char* header, const char* code) {
    const Imported data = imported(std::string("q1_deg\tx_mm\t") + header + "\n1\t2\t0.024\n");
    const Problem* problem = remark(data, code);
    return problem == nullptr ? std::string() : problem->help;
  };
  EXPECT_TRUE(has(help("U95 X (mm)", "N-IMPORT-EXPANDED"), "--map \"U95 X (mm)=sx_mm\""));
  EXPECT_TRUE(has(help("U95 X (um)", "N-IMPORT-EXPANDED"), "--map \"U95 X (um)=sx_um\""));
  EXPECT_TRUE(has(help("Uncertainty X [mm]", "W-IMPORT-UNCERTAINTY"), "X [mm]=sx_mm\""));
  EXPECT_TRUE(has(help("Uncertainty X [mm]", "W-IMPORT-UNCERTAINTY"), "u95x_mm if two"));
  EXPECT_TRUE(has(help("Uncertainty X", "W-IMPORT-UNCERTAINTY"), "mm in place of um"));
  const Imported told = imported("q1_deg\tx_mm\tU\n1\t2\t24\n", mapped("U=u95x_um"));
  EXPECT_EQ(told.find("sx")->text[0], "12");
}

TEST(Import, RadiansUnderHeadingsOfDegreesAreAskedForAndNeverChanged) {
  const auto table = [](const char* heads, double scale, double point) {
    std::string out = heads;
    for (int i = 0; i < 30; ++i)
      out += fmt::format("{:.6f},{:.6f},{:.6f},{:.3f},{:.3f},{:.3f}\n", scale * std::sin(1.7 * i),
                         scale * std::sin(2.9 * i), scale * std::cos(0.7 * i),
                         point * std::sin(1.7 * i), point * std::cos(1.7 * i),
                         point * std::sin(2.9 * i));
    return out;
  };
  const char* degrees = "q1_deg,q2_deg,q3_deg,x_mm,y_mm,z_mm\n";
  const Imported data = imported(table(degrees, 2.5, 900.0));
  const Problem* asked = remark(data, "W-IMPORT-RADIANS");
  ASSERT_NE(asked, nullptr);
  EXPECT_EQ(offered(*asked), "q1_deg=q1_rad,q2_deg=q2_rad,q3_deg=q3_rad");
  EXPECT_EQ(data.find("q1")->unit, "deg");
  const Imported told = imported(table(degrees, 2.5, 900.0), mapped(offered(*asked)));
  EXPECT_EQ(told.find("q1")->unit, "rad");
  EXPECT_EQ(remark(told, "W-IMPORT-RADIANS"), nullptr);
  EXPECT_EQ(remark(imported(table(degrees, 120.0, 900.0)), "W-IMPORT-RADIANS"), nullptr);
  EXPECT_EQ(remark(imported(table(degrees, 2.5, 30.0)), "W-IMPORT-RADIANS"), nullptr);
  EXPECT_EQ(remark(imported(table("q1_rad,q2_rad,q3_rad,x_mm,y_mm,z_mm\n", 2.5, 900.0)),
                   "W-IMPORT-RADIANS"),
            nullptr);
}

TEST(Import, TextOfAnotherEncodingIsRefusedWithTheCommandThatConvertsIt) {
  // X座標 and 温度 in Shift-JIS, 坐标X and 温度 in GB 18030, Ось and Координата in Windows-1251.
  const Problem japanese = refused("q1_deg,X\x8D\xC0\x95\x57_mm,\x89\xB7\x93\x78\n1,2,20\n");
  EXPECT_EQ(japanese.code, "E-IMPORT-ENCODING");
  EXPECT_TRUE(has(japanese.message, "Shift-JIS")) << japanese.message;
  EXPECT_TRUE(has(japanese.help, "iconv -f CP932 -t UTF-8")) << japanese.help;
  for (const char* other :
       {"q1_deg,\xD7\xF8\xB1\xEAX_mm,\xCE\xC2\xB6\xC8\n1,2,20\n",
        "\xCE\xF1\xFC 1 deg,\xCA\xEE\xEE\xF0\xE4\xE8\xED\xE0\xF2\xE0 X mm\n1,2\n"}) {
    const Problem problem = refused(other);
    EXPECT_EQ(problem.code, "E-IMPORT-ENCODING") << problem.message;
    EXPECT_TRUE(has(problem.help, "UTF-8")) << problem.help;
  }
  // European text stays what it was: L\u00E4nge, Gr\u00F6\u00DFe, quotation marks and dashes.
  for (const char* european : {"q1_deg,x_mm,L\xE4nge\n1,2,20\n",
                               "q1_deg,x_mm,Gr\xF6\xDF"
                               "e\n1,2,20\n",
                               "q1_deg,x_mm,\x93Soll\x94 A1\x96"
                               "A6\n1,2,20\n",
                               "q1 [\xB0],x_mm,\xE9t\xE9\n1,2,20\n"})
    EXPECT_EQ(imported(european).remarks.front().code, "N-IMPORT-ENCODING") << european;
}

TEST(Import, AMapOfAnotherKindOfUnitIsRefusedWithTheKindsInWords) {
  for (const auto& [wish, words] : std::vector<std::pair<std::string, std::string>>{
           {"A=x_deg", "x is a length, but deg measures an angle"},
           {"A=x_kg", "x is a length, but kg measures a mass"},
           {"A=nz_s", "nz is a length, but s measures a time"},
           {"A=sx_rad", "sx is a length"},
           {"A=u95x_deg", "sx is a length"},
           {"A=q2_kg", "q2 is an angle or a length, but kg"},
           {"A=payload_mm", "payload is a mass"},
           {"A=temp_deg", "temp is a temperature"},
           {"A=temp_elbow_mm", "is a temperature"},
           {"A=t_mm", "t is a time"}}) {
    const Problem problem = refused("A,q1_deg\n1,2\n", mapped(wish));
    EXPECT_EQ(problem.code, "E-IMPORT-MAP") << wish;
    EXPECT_TRUE(has(problem.message, words)) << problem.message;
    EXPECT_TRUE(has(problem.help, "--map \"A=")) << problem.help;
    EXPECT_NE(refused("A,q1_deg\n1,2\n", mapped(offered(problem))).code, "E-IMPORT-MAP") << wish;
  }
  EXPECT_EQ(refused("A,x_mm\n1,2\n", mapped("A=pressure_N")).code, "accepted");
}

TEST(Import, AJointMappedToALengthIsSaidToSlide) {
  const Imported data = imported("A,x_mm\n1,2\n", mapped("A=q1_mm"));
  const Problem* note = remark(data, "N-IMPORT-SLIDE");
  ASSERT_NE(note, nullptr);
  EXPECT_EQ(offered(*note), "A=q1_deg");
  EXPECT_EQ(remark(imported("A,x_mm\n1,2\n", mapped("A=q1_deg")), "N-IMPORT-SLIDE"), nullptr);
}

TEST(Import, ADateAndATimeOfDayAreOneTimeStamp) {
  const Imported data = imported(
      "Punkt;Datum;Uhrzeit;q1_deg;x_mm\nA;20.10.2022;16:57;1,5;2,5\n"
      "B;21.10.2022;16:58;2,5;3,5\n");
  EXPECT_EQ(tests::texts_of(*data.find("t")), (std::vector<std::string>{"0", "86460"}));
}

TEST(Import, ATimeOfPlainNumbersIsAskedForItsUnitAndOneWithAUnitKeepsIt) {
  EXPECT_EQ(refused("Time,q1_deg,x_mm\n0,1,2\n500,2,3\n").code, "E-IMPORT-UNIT");
  EXPECT_EQ(imported("Time [ms],q1_deg,x_mm\n0,1,2\n500,2,3\n").find("t")->unit, "ms");
}

TEST(Import, AMappingMayNameAColumnOfTheOtherFile) {
  ImportWishes wishes = mapped("S1=q1_deg,Xm=x_mm");
  EXPECT_EQ(refused("pose,S1\na,1\n", wishes).code, "E-IMPORT-MAP");
  wishes.elsewhere = {"pose", "Xm"};
  EXPECT_EQ(imported("pose,S1\na,1\n", wishes).find("q1")->text[0], "1");
  wishes.map.push_back("Ym=y_mm");
  EXPECT_TRUE(has(refused("pose,S1\na,1\n", wishes).message, "neither file has a column 'Ym'"));
}

TEST(Import, WhatACalibrationLacksIsNamedWithItsCandidates) {
  const Imported data = imported("S1,S2,S3,Px,Py,Pz\n10,90,3,1000,2,3\n1,80,170,900,5,6\n");
  const auto missing = missing_for_calibration(data, 0);
  ASSERT_TRUE(missing.has_value());
  EXPECT_EQ(missing->code, "E-IMPORT-MISSING");
  EXPECT_EQ(offered(*missing), "S1=q1_deg,S2=q2_deg,S3=q3_deg,Px=x_mm,Py=y_mm,Pz=z_mm");
  const Imported gap = imported("q1_deg,q3_deg,x_mm\n1,2,3\n4,5,6\n");
  EXPECT_TRUE(has(missing_for_calibration(gap, 0)->message, "q2"));
  const Imported whole = imported("q1_deg,q2_deg,x_mm\n1,2,3\n4,5,6\n");
  EXPECT_FALSE(missing_for_calibration(whole, 2).has_value());
  EXPECT_TRUE(has(missing_for_calibration(whole, 3)->message, "q3 of an arm of 3 joints"));
  // Rows that touch fixed points need no position; points of a tracker all have names of their own.
  const Imported touched = imported("q1_deg,point\n1,A\n2,B\n3,A\n");
  EXPECT_FALSE(missing_for_calibration(touched, 1).has_value());
  const Imported named = imported("q1_deg,point\n1,A\n2,B\n3,C\n");
  EXPECT_TRUE(has(missing_for_calibration(named, 1)->message, "the measured position"));
}

TEST(Timestamps, DatesOfManyCountriesCountTheSameSeconds) {
  const std::vector<double> expected{0.0, 60.0, 86460.0};
  const std::vector<std::vector<std::string_view>> kSame{
      {"20.10.2022 16:57", "20.10.2022 16:58", "21.10.2022 16:58"},
      {"20.10.2022 16:57:03", "20.10.2022 16:58:03", "21.10.2022 16:58:03"},
      {"20/10/2022 16:57:03,5", "20/10/2022 16:58:03,5", "21/10/2022 16:58:03,5"},
      {"10/20/2022 4:57:03 PM", "10/20/2022 4:58:03 PM", "10/21/2022 4:58:03 PM"},
      {"20-10-2022 16:57", "20-10-2022 16:58", "21-10-2022 16:58"},
      {"20.10.22 16:57", "20.10.22 16:58", "21.10.22 16:58"},
      {"2022/10/20 16:57", "2022/10/20 16:58", "2022/10/21 16:58"},
      {"2022-10-20T16:57:03+02:00", "2022-10-20T14:58:03Z", "2022-10-21T16:58:03+02:00"},
      {"20-Oct-2022 16:57:03", "20-Oct-2022 16:58:03", "21-Oct-2022 16:58:03"},
      {"20. Okt. 2022 16:57", "20. Okt. 2022 16:58", "21. Okt. 2022 16:58"},
      {"Oct 20, 2022 16:57", "Oct 20, 2022 16:58", "Oct 21, 2022 16:58"}};
  for (const auto& cells : kSame) {
    const Timestamps times = tests::timestamps_in(cells, ',');
    ASSERT_EQ(times.seconds.size(), 3U) << cells[0] << ": " << times.damage;
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(times.seconds[i], expected[i], 1e-6) << cells[0];
  }
}

TEST(Timestamps, DayAndMonthAreToldByTheWholeColumnOrAskedFor) {
  const Timestamps told = tests::timestamps_in({"03/04/2022 16:57", "03/13/2022 16:57"}, '.');
  EXPECT_EQ(told.format, "MM/DD/YYYY hh:mm");
  EXPECT_NEAR(told.seconds[1], 9 * 86400.0, 1e-6);
  const std::vector<std::string_view> open{"03/04/2022 16:57", "04/04/2022 16:57"};
  EXPECT_TRUE(tests::timestamps_in(open, '.').undecided);
  EXPECT_NEAR(tests::timestamps_in(open, '.', DateOrder::kDayFirst).seconds[1], 86400.0, 1e-6);
  EXPECT_NEAR(tests::timestamps_in(open, '.', DateOrder::kMonthFirst).seconds[1], 31 * 86400.0,
              1e-6);
  EXPECT_FALSE(tests::timestamps_in({"03/04/2022 16:57", "03/04/2022 16:58"}, '.').undecided);
  EXPECT_FALSE(tests::timestamps_in({"13/01/2022 16:57", "01/13/2022 16:58"}, '.').damage.empty());
}

TEST(Timestamps, NonsenseIsNeverATime) {
  for (const char* cell : {"32.10.2022 16:57", "20.13.2022 16:57", "20.10.2022 25:57",
                           "20.10.2022 16:61", "20.10.2022", "10/20/2022 13:57 PM", "20 10 2022",
                           "2022-02-30 16:57", "20.10.2022 16:57 x", ""})
    EXPECT_TRUE(tests::timestamps_in({cell, cell}, '.').seconds.empty()) << cell;
}

}  // namespace
}  // namespace plumb::offline
