// SPDX-License-Identifier: Apache-2.0
#include "cell/artefacts.hpp"

#include <gtest/gtest.h>

#include "cell/measurement_reader.hpp"
#include "cell/setups.hpp"
#include "tests/cell/support.hpp"

namespace plumb::offline {
namespace {

using Summary = std::vector<std::string>;

class TouchedRows : public testing::Test {
 protected:
  MeasurementFiles read(const std::vector<std::string>& texts) {
    std::vector<std::filesystem::path> files;
    for (std::size_t i = 0; i < texts.size(); ++i)
      files.push_back(folder_.put(std::string(1, static_cast<char>('a' + i)) + ".csv", texts[i]));
    MeasurementFiles m = read_measurements(files, {true}, Needs::kJointsAndPosition);
    list_artefacts(m.tables, cell_.measurement);
    assign_setups(cell_, files, m);
    return m;
  }
  Summary errors(const std::string& text) {
    return summary(problems_of([&] { read({text}); }));
  }
  Folder folder_;
  Cell cell_;
};

TEST_F(TouchedRows, EachPointIsASetupAndAllShareOneTarget) {
  const MeasurementFiles m = read(
      {"q1_deg,point,position\n1,A,left\n2,B,left\n3,A,left\n4,B,left\n5,C,right\n6,C,right\n"});
  const auto& setups = cell_.measurement.setups;
  ASSERT_EQ(setups.size(), 3u);
  EXPECT_EQ(m.setup, (std::vector<int>{0, 1, 0, 1, 2, 2}));
  EXPECT_EQ(m.placement, (std::vector<int>{0, 0, 0, 0, 1, 1}));
  EXPECT_EQ(setups[1].name, "B");
  EXPECT_EQ(setups[1].position, "left");
  EXPECT_EQ(target_root(cell_.measurement, 2), 0);
  EXPECT_TRUE(of_artefact(cell_.measurement, 2));
  EXPECT_TRUE(m.p_M.isZero(0.0));
  EXPECT_TRUE(m.has_axis[0] && m.has_axis[1] && m.has_axis[2]);
  EXPECT_TRUE(lacks_length(cell_));
}

TEST_F(TouchedRows, WithoutPositionsEachPointIsAPlacement) {
  EXPECT_EQ(read({"q1_deg,point\n1,A\n2,B\n3,A\n4,B\n"}).placement, (std::vector<int>{0, 1, 0, 1}));
}

TEST_F(TouchedRows, StandBesideMeasuredPositionsOfAnotherFile) {
  const MeasurementFiles m = read({"q1_deg,x_mm,y_mm\n1,2,3\n2,3,4\n", "q1_deg,point\n1,A\n2,A\n"});
  EXPECT_EQ(m.setup, (std::vector<int>{0, 0, 1, 1}));
  EXPECT_EQ(m.placement, (std::vector<int>{-1, -1, 0, 0}));
  EXPECT_FALSE(m.has_axis[2]);
  EXPECT_FALSE(m.of_artefact(1));
  EXPECT_TRUE(m.of_artefact(2));
  EXPECT_EQ(target_root(cell_.measurement, 1), 1);
  EXPECT_FALSE(lacks_length(cell_));
}

TEST_F(TouchedRows, ALabelOfAMeasuredPositionIsNoPoint) {
  const MeasurementFiles m = read({"q1_deg,point,x_mm\n1,A,2\n2,A,3\n"});
  EXPECT_TRUE(cell_.measurement.setups.empty());
  EXPECT_TRUE(m.placement.empty());
}

TEST_F(TouchedRows, LabelsThatAreAllDifferentAreNamesOfPositionsThatAreMissing) {
  EXPECT_EQ(errors("q1_deg,point\n1,A\n2,B\n"), Summary{"E-CSV-POSITION 1:13"});
}

TEST_F(TouchedRows, KnownDistancesAreListedOnce) {
  read({"q1_deg,point,to_point,distance_mm\n1,A,B,50\n2,A,B,50\n3,B,A,50\n4,B,A,50\n"});
  const auto& lengths = cell_.measurement.lengths;
  ASSERT_EQ(lengths.size(), 1u);
  EXPECT_EQ(lengths[0].from, 0);
  EXPECT_EQ(lengths[0].to, 1);
  EXPECT_DOUBLE_EQ(lengths[0].length_m, 0.05);
  EXPECT_FALSE(lacks_length(cell_));
}

TEST_F(TouchedRows, WhatContradictsIsRefusedWithItsPlace) {
  EXPECT_EQ(errors("q1_deg,point\n1,A\n2,A\n3,\n"), Summary{"E-CSV-POINT 4:3"});
  EXPECT_EQ(errors("q1_deg,point\n1,A\n2,A\n3,a\n4,a\n"), Summary{"E-CSV-POINT 4:3"});
  const std::string known = "q1_deg,point,to_point,distance_mm\n1,A,B,50\n2,B,A,";
  EXPECT_EQ(errors(known + "51\n3,A,,1\n"), Summary{"E-CSV-POINT 3:7"});
  EXPECT_EQ(errors(known + "0\n3,A,,1\n"), Summary{"E-CSV-POINT 3:7"});
  EXPECT_EQ(errors("q1_deg,point,to_point,distance_mm\n1,A,C,50\n2,A,A,51\n"),
            (Summary{"E-CSV-POINT 2:5", "E-CSV-POINT 3:5"}));
  EXPECT_EQ(errors("q1_deg,point,to_point\n1,A,B\n2,A,B\n"), Summary{"E-CSV-POINT 1:14"});
}

TEST_F(TouchedRows, APointTouchedOnceIsNotUsed) {
  const MeasurementFiles m = read({"q1_deg,point\n1,A\n2,A\n3,B\n"});
  EXPECT_EQ(m.set[1], SetMark::kUnmarked);
  EXPECT_EQ(m.set[2], SetMark::kIgnore);
  EXPECT_EQ(summary(m.tables[0].remarks), Summary{"W-CSV-POINT 1:8"});
}

class OtherArtefacts : public TouchedRows {};

TEST_F(OtherArtefacts, ARowReadsTheLinesOfItsKindAndNoMore) {
  const MeasurementFiles m =
      read({"q1_deg,x_mm,y_mm\n1,2,3\n2,3,4\n", "q1_deg,plane\n1,T\n2,T\n3,T\n4,T\n",
            "q1_deg,plane,height_mm\n1,U,1.5\n2,U,2\n3,U,2\n4,U,3\n",
            "q1_deg,anchor,distance_mm\n1,W,700\n2,W,800\n3,W,1\n4,W,2\n"});
  using enum ReadingKind;
  EXPECT_EQ(m.kind[0], kPosition);
  EXPECT_EQ(m.kind[2], kPlane);
  EXPECT_EQ(m.kind[6], kHeight);
  EXPECT_EQ(m.kind[10], kDistance);
  EXPECT_EQ(m.axes(0), 2);
  EXPECT_EQ(m.axes(2), 1);
  EXPECT_TRUE(m.reads(2, 2));
  EXPECT_FALSE(m.reads(2, 0));
  EXPECT_DOUBLE_EQ(m.p_M(6, 2), 0.0015);
  EXPECT_DOUBLE_EQ(m.p_M(10, 0), 0.7);
  EXPECT_EQ(cell_.measurement.setups.size(), 4u);
  EXPECT_DOUBLE_EQ(m.mean_axes(), (2 * 2 + 12) / 14.0);
}

TEST_F(OtherArtefacts, AreTouchedWhereNothingButTheJointsIsRead) {
  using enum ReadingKind;
  for (const auto kind : {kPoint, kPlane, kSphere}) EXPECT_TRUE(is_touch(kind));
  for (const auto kind : {kPosition, kHeight, kDistance}) EXPECT_FALSE(is_touch(kind));
}

TEST_F(OtherArtefacts, OnlyAStatedRadiusOrADistanceIsALength) {
  const auto lacks = [&](const std::string& text) {
    cell_.measurement.setups.clear();
    read({text});
    return lacks_length(cell_);
  };
  EXPECT_TRUE(lacks("q1_deg,plane\n1,A\n2,A\n"));
  EXPECT_TRUE(lacks("q1_deg,plane,height_mm\n1,A,1\n2,A,2\n"));
  EXPECT_TRUE(lacks("q1_deg,sphere\n1,A\n2,A\n"));
  EXPECT_FALSE(lacks("q1_deg,sphere,radius_mm\n1,A,100\n2,A,100\n"));
  EXPECT_FALSE(lacks("q1_deg,anchor,distance_mm\n1,A,700\n2,A,800\n"));
  EXPECT_FALSE(lacks("q1_deg,anchor,extension_mm\n1,A,700\n2,A,800\n"));
}

TEST_F(OtherArtefacts, HaveAnUnknownLengthWhereNothingStatesIt) {
  const auto fitted = [&](const std::string& text) {
    cell_.measurement.setups.clear();
    read({text});
    return cell_.measurement.setups.front().fit_length;
  };
  EXPECT_TRUE(fitted("q1_deg,sphere\n1,A\n2,A\n"));
  EXPECT_FALSE(fitted("q1_deg,sphere,radius_mm\n1,A,100\n2,A,100\n"));
  EXPECT_DOUBLE_EQ(cell_.measurement.setups.front().length_m, 0.1);
  EXPECT_FALSE(fitted("q1_deg,anchor,distance_mm\n1,A,700\n2,A,800\n"));
  EXPECT_TRUE(fitted("q1_deg,anchor,extension_mm\n1,A,700\n2,A,800\n"));
}

TEST_F(OtherArtefacts, ContradictionsAndGapsAreRefusedWithTheirPlace) {
  EXPECT_EQ(errors("q1_deg,anchor\n1,A\n2,A\n"), Summary{"E-CSV-POINT 1:8"});
  EXPECT_EQ(errors("q1_deg,sphere,radius_mm\n1,A,100\n2,A,101\n"), Summary{"E-CSV-POINT 3:5"});
  EXPECT_EQ(errors("q1_deg,sphere,radius_mm\n1,A,0\n2,A,0\n"),
            (Summary{"E-CSV-POINT 2:5", "E-CSV-POINT 3:5"}));
  EXPECT_EQ(errors("q1_deg,plane,sphere\n1,A,B\n2,A,B\n"), Summary{"E-CSV-POINT 1:14"});
  const auto two_files = [&] { read({"q1_deg,plane\n1,A\n2,A\n", "q1_deg,sphere\n1,A\n2,A\n"}); };
  EXPECT_EQ(summary(problems_of(two_files)), (Summary{"E-CSV-POINT 2:3", "E-CSV-POINT 3:3"}));
}

TEST_F(OtherArtefacts, ColumnsThatDoNotBelongAreRefused) {
  for (const char* header :
       {"plane,radius_mm", "plane,distance_mm", "plane,extension_mm", "sphere,height_mm",
        "sphere,distance_mm", "point,height_mm", "point,radius_mm"}) {
    SCOPED_TRACE(header);
    const auto found = errors(std::string("q1_deg,") + header + "\n1,A,100\n2,A,100\n");
    ASSERT_EQ(found.size(), 1u);
    EXPECT_TRUE(found.front().starts_with("E-CSV-POINT 1:")) << found.front();
  }
  EXPECT_EQ(errors("q1_deg,anchor,distance_mm,extension_mm\n1,A,9,1\n2,A,9,1\n"),
            Summary{"E-CSV-POINT 1:15"});
  EXPECT_EQ(errors("q1_deg,plane,anchor\n1,A,B\n2,A,B\n"), Summary{"E-CSV-POINT 1:14"});
}

TEST_F(OtherArtefacts, ReadingsThatNoArmCanMakeAreRefused) {
  EXPECT_EQ(errors("q1_deg,anchor,distance_mm\n1,A,-700\n2,A,800\n"), Summary{"E-CSV-POINT 2:5"});
  EXPECT_EQ(errors("q1_deg,anchor,distance_mm\n1,A,700\n2,A,1e300\n"), Summary{"E-CSV-POINT 3:5"});
  EXPECT_EQ(errors("q1_deg,plane,height_mm\n1,A,1\n2,A,1e9\n"), Summary{"E-CSV-POINT 3:5"});
  EXPECT_NO_THROW(read({"q1_deg,anchor,extension_mm\n1,A,-700\n2,A,0\n"}));
}

TEST_F(OtherArtefacts, OneArtefactStandsInOnePlaceAndHasOneKindOfReading) {
  EXPECT_EQ(errors("q1_deg,plane,position\n1,A,X\n2,A,Y\n"), Summary{"E-CSV-POINT 3:5"});
  EXPECT_EQ(errors("q1_deg,plane,position\n1,A,X\n2,A,\n"), Summary{"E-CSV-POINT 3:5"});
  const auto two_files = [&] {
    read({"q1_deg,anchor,distance_mm\n1,A,700\n2,A,800\n",
          "q1_deg,anchor,extension_mm\n1,A,1\n2,A,2\n"});
  };
  EXPECT_EQ(summary(problems_of(two_files)), (Summary{"E-CSV-POINT 2:3", "E-CSV-POINT 3:3"}));
}

TEST_F(OtherArtefacts, WithNoMoreReadingsThanUnknownNumbersAreNotUsed) {
  const MeasurementFiles m = read({"q1_deg,plane\n1,A\n2,A\n3,A\n4,B\n5,B\n6,B\n7,B\n"});
  EXPECT_EQ(m.set[2], SetMark::kIgnore);
  EXPECT_EQ(m.set[3], SetMark::kUnmarked);
  EXPECT_EQ(summary(m.tables[0].remarks), Summary{"W-CSV-POINT 1:8"});
}

}  // namespace
}  // namespace plumb::offline
