// SPDX-License-Identifier: Apache-2.0
#include "show/heat_map.hpp"

#include <gtest/gtest.h>

#include "show/study_figures.hpp"

namespace plumb::offline::show {
namespace {

HeatMap two_by_three() {
  HeatMap out;
  out.title = "a < b & c";
  out.value.resize(2, 3);
  out.value << 0.0, 0.0, 1.0,  //
      1.0, 0.5, 2.0;
  return out;
}

int count(const std::string& text, const std::string& what) {
  int out = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++out;
  return out;
}

TEST(HeatMap, EqualNeighboursAreOneRectangleAndNothingIsLost) {
  const std::string text = svg(two_by_three());
  // Background, the frame of the axes, 64 of the colour bar; rows of 2 and 3 different runs.
  EXPECT_EQ(count(text, "<rect"), 1 + 1 + 64 + 2 + 3);
}

TEST(HeatMap, ValuesBeyondTheScaleTakeItsLastColour) {
  const std::string text = svg(two_by_three());
  EXPECT_EQ(count(text, "fill=\"#ffea46\"/>"), 1 + 3) << "the bar's end, 1 twice, and 2";
}

TEST(HeatMap, TitlesAreEscaped) {
  const std::string text = svg(two_by_three());
  EXPECT_NE(text.find("a &lt; b &amp; c"), std::string::npos);
}

TEST(HeatMap, AConstantMapIsDrawn) {
  HeatMap map = two_by_three();
  map.value.setZero();
  map.most = 0.0;
  EXPECT_EQ(svg(map).find("nan"), std::string::npos);
}

}  // namespace
}  // namespace plumb::offline::show
