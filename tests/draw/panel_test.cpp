// SPDX-License-Identifier: Apache-2.0
#include "draw/panel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <regex>

#include "draw/sheet.hpp"
#include "tests/draw/text_boxes.hpp"

namespace plumb::offline::draw {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(Panel, PutsTheEndsOfItsAxesAtTheCornersOfItsFrame) {
  Svg svg(500.0);
  const Panel panel(svg, {0.0, 0.0, 500.0, 300.0}, {.low = 0.0, .high = 8.7},
                    {.low = 0.02, .high = 30.0, .scale = Axis::Scale::kLog});
  EXPECT_DOUBLE_EQ(panel.x_low(), 0.0);
  EXPECT_DOUBLE_EQ(panel.x_high(), 9.0);
  EXPECT_NEAR(panel.x_at(0.0), panel.plot().left, 1e-9);
  EXPECT_NEAR(panel.x_at(9.0), panel.plot().right, 1e-9);
  EXPECT_NEAR(panel.y_at(panel.y_low()), panel.plot().bottom, 1e-9);
  EXPECT_NEAR(panel.y_at(panel.y_high()), panel.plot().top, 1e-9);
  const double middle = std::sqrt(panel.y_low() * panel.y_high());
  EXPECT_NEAR(panel.y_at(middle), 0.5 * (panel.plot().top + panel.plot().bottom), 1e-9);
}

TEST(Panel, NoLabelTouchesAnotherAtAnyWidthAndRange) {
  for (const double width : {1280.0, 700.0, 400.0, 320.0})
    for (const auto& [low, high] : std::vector<std::pair<double, double>>{
             {0.0, 1.0}, {-1e6, 1e6}, {0.00012, 0.00013}, {5.0, 5.0}, {kNan, kNan}}) {
      Sheet sheet(width,
                  {.title = "A title that is long enough to be wrapped at four hundred pixels",
                   .sentence = "A sentence of some length, computed from the data, to be read.",
                   .legend = {{.words = "first", .area = Tone::kBlue},
                              {.words = "second, with more words", .line = LineStyle{}},
                              {.words = "third", .mark = Mark{}}},
                   .notes = {"A note that says what was left out and why, at some length."}});
      for (const Box& room : sheet.grid(5, 150.0, 180.0)) {
        Panel panel(sheet.svg(), room, {.title = "position [deg]", .low = low, .high = high},
                    {.title = "deviation [µrad]", .low = low, .high = high}, "J1");
        for (int i = 0; i < 20; ++i) panel.label(0.5 * (low + high), 0.5 * (low + high), "a label");
        panel.levels_y({{high, "tolerance 0.1 mm", {}}, {high, "noise floor 0.1 mm", {}}});
        panel.levels_x({{low, "limit", {}}});
      }
      const std::string file = sheet.file();
      EXPECT_EQ(collisions(file, width), "") << width << " " << low << " " << high;
      EXPECT_EQ(file.find("nan"), std::string::npos);
      EXPECT_EQ(count(file, ">J1<"), 5);
    }
}

TEST(Panel, ALineStaysInsideItsFrameAndNothingOfItIsLost) {
  Svg svg(500.0);
  Panel panel(svg, {0.0, 0.0, 500.0, 300.0}, {.title = "x"}, {.title = "y"});
  const std::string before = svg.file(300.0, "");
  panel.line({{0.0, 0.5}, {0.25, 40.0}, {0.5, 0.5}, {0.75, -40.0}, {kNan, 0.0}, {1.0, 0.5}}, {});
  const std::string file = svg.file(300.0, "");
  const std::string path = file.substr(file.rfind("<path d=\""));
  const Box frame = panel.plot();
  const std::regex place("[ML](-?[0-9.]+) ?(-?[0-9.]+)");
  int places = 0;
  for (auto it = std::sregex_iterator(path.begin(), path.end(), place);
       it != std::sregex_iterator(); ++it, ++places) {
    EXPECT_GE(std::stod((*it)[1]), frame.left - 0.1);
    EXPECT_LE(std::stod((*it)[1]), frame.right + 0.1);
    EXPECT_GE(std::stod((*it)[2]), frame.top - 0.1) << path;
    EXPECT_LE(std::stod((*it)[2]), frame.bottom + 0.1) << path;
  }
  EXPECT_EQ(places, 5) << "up and out; in, through and out below";
}

TEST(Panel, TheNameOfALevelAvoidsMarksAndOtherLevels) {
  Svg svg(500.0);
  Panel panel(svg, {0.0, 0.0, 500.0, 300.0}, {.title = "x"}, {.title = "y"});
  for (int i = 50; i < 100; ++i) panel.mark(0.01 * i, 0.52, {});
  panel.levels_y({{0.5, "floor", {}}});
  panel.levels_x({{0.4, "first", {}}, {0.42, "second", {}}});
  const auto boxes = text_boxes(svg.file(300.0, ""));
  const auto of = [&](const std::string& words) {
    return *std::find_if(boxes.begin(), boxes.end(),
                         [&](const TextBox& box) { return box.words == words; });
  };
  const TextBox floor = of("floor"), first = of("first");
  EXPECT_TRUE(floor.top > panel.y_at(0.5) || floor.right < panel.x_at(0.5));
  EXPECT_LT(first.right, panel.x_at(0.42)) << "on the side where the other line is not";
}

TEST(Panel, TheNameOfALevelRatherCoversMarksThanAnotherLevel) {
  Svg svg(400.0);
  Panel panel(svg, {0.0, 0.0, 400.0, 300.0}, {.title = "x"}, {.title = "y"});
  for (int i = 0; i < 30; ++i)
    for (int k = 0; k <= 100; ++k) panel.mark(0.01 * i, 0.01 * k, {});
  panel.levels_x({{0.3, "noise floor", {}}, {0.35, "tolerance", {}}});
  const auto boxes = text_boxes(svg.file(300.0, ""));
  const auto floor = std::find_if(boxes.begin(), boxes.end(),
                                  [](const TextBox& box) { return box.words == "noise floor"; });
  ASSERT_NE(floor, boxes.end());
  EXPECT_LT(floor->right, panel.x_at(0.3));
}

TEST(Panel, ALogarithmicAxisSaysSo) {
  Svg svg(500.0);
  const Panel panel(svg, {0.0, 0.0, 500.0, 300.0},
                    {.title = "error [mm]", .low = 0.1, .high = 9.0, .scale = Axis::Scale::kLog},
                    {.title = "poses"});
  const std::string file = svg.file(300.0, "");
  EXPECT_NE(file.find(">error [mm], log scale<"), std::string::npos);
  EXPECT_EQ(file.find(">poses, log"), std::string::npos);
}

}  // namespace
}  // namespace plumb::offline::draw
