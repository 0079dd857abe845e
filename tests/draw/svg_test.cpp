// SPDX-License-Identifier: Apache-2.0
#include "draw/svg.hpp"

#include <gtest/gtest.h>

#include "draw/text_width.hpp"
#include "tests/draw/text_boxes.hpp"
#include "tests/draw/well_formed.hpp"

namespace plumb::offline::draw {
namespace {

TEST(Escaping, LeavesNothingThatEndsATextOrAnAttribute) {
  EXPECT_EQ(escaped("<script>alert('1' & \"2\")</script>"),
            "&lt;script&gt;alert(&#39;1&#39; &amp; &quot;2&quot;)&lt;/script&gt;");
  EXPECT_EQ(escaped("Grüße µ"), "Grüße µ");
  EXPECT_EQ(escaped(std::string("a\0b\x1b[1m", 7)), "a\uFFFDb\uFFFD[1m") << "XML forbids them";
  EXPECT_EQ(escaped("a\xff\xfe z"), "a\uFFFD\uFFFD z");
}

TEST(Svg, HostileNamesStayWordsInEveryPlace) {
  const std::string name = "\"/><script>alert(1)</script>";
  Svg svg(400.0);
  svg.text({10.0, 20.0}, Anchor::kStart, name);
  for (const Shape shape : {Shape::kCircle, Shape::kDiamond})
    svg.mark({50.0, 50.0}, {.shape = shape, .pose = name, .words = name});
  svg.arrow({0.0, 0.0}, {9.0, 9.0}, {}, name, name);
  svg.box({0.0, 0.0, 9.0, 9.0}, Tone::kBlue, {}, name, name);
  const std::string file = svg.file(100.0, name);
  EXPECT_EQ(file.find("<script"), std::string::npos);
  EXPECT_EQ(count(file, "data-pose=\"&quot;/&gt;&lt;script&gt;"), 4);
}

TEST(Svg, ATextThatWouldTouchAnotherIsNotDrawn) {
  Svg svg(300.0);
  EXPECT_TRUE(svg.text({10.0, 50.0}, Anchor::kStart, "first"));
  EXPECT_FALSE(svg.text({20.0, 52.0}, Anchor::kStart, "second"));
  EXPECT_TRUE(svg.text({10.0, 80.0}, Anchor::kStart, "second"));
  EXPECT_FALSE(svg.text({290.0, 110.0}, Anchor::kStart, "beyond the edge"));
  const std::string file = svg.file(120.0, "");
  EXPECT_EQ(text_boxes(file).size(), 2U);
  EXPECT_EQ(collisions(file, 300.0), "");
}

TEST(Svg, TheTestOfCollisionsSeesAPlantedOne) {
  const std::string two =
      "<text x=\"10\" y=\"20\" text-anchor=\"start\" font-size=\"12\">abcdef</text>"
      "<text x=\"30\" y=\"20\" text-anchor=\"start\" font-size=\"12\">ghi</text>";
  EXPECT_EQ(collisions(two, 300.0), "'abcdef' touches 'ghi'\n");
}

TEST(WellFormed, SeesWhatIsNot) {
  for (const auto* bad :
       {"<a>", "<a></b>", "<a>&</a>", "<a b=\"></a>", "x<a/>", "<a <b/></a>", "<a>></a>"})
    EXPECT_NE(tests::xml_fault(bad), "") << bad;
  EXPECT_EQ(tests::xml_fault("<a b=\"1\"><c/>&lt;</a>\n"), "");
}

TEST(Svg, PlacesThatAreNoNumbersAreNotDrawn) {
  Svg svg(300.0);
  svg.mark({NAN, 3.0}, {});
  svg.arrow({NAN, 3.0}, {1.0, 2.0}, {});
  svg.box({NAN, 0.0, 1.0, 1.0}, Tone::kBlue);
  svg.polyline({{1.0, 1.0}, {NAN, 2.0}, {3.0, 3.0}}, {});
  const std::string file = svg.file(50.0, "");
  EXPECT_EQ(file.find("nan"), std::string::npos);
  EXPECT_NE(file.find("M1 1M3 3"), std::string::npos) << "a gap, not a line across it";
}

TEST(Svg, HasALightAndADarkFaceAndAFallbackForReadersWithoutVariables) {
  Svg svg(300.0);
  svg.line({0.0, 0.0}, {9.0, 9.0}, {.paint = Tone::kBlue});
  const std::string file = svg.file(50.0, "");
  EXPECT_NE(file.find("prefers-color-scheme:dark"), std::string::npos);
  EXPECT_NE(file.find(".plumb-dark .plumb-figure"), std::string::npos);
  EXPECT_NE(file.find("class=\"s5\" fill=\"none\" stroke=\"#0072b2\""), std::string::npos);
}

TEST(Text, IsWrappedAndShortenedToItsRoom) {
  for (const double width : {60.0, 150.0, 400.0})
    for (const auto& line :
         wrapped("The error is largest at J2 between 60 and 80 deg", 13.0, width))
      EXPECT_LE(text_width(line, 13.0), width) << line;
  EXPECT_LE(text_width(shortened("µµµµµµµµµµ", 12.0, 50.0), 12.0), 50.0);
  EXPECT_EQ(shortened("abc", 12.0, 50.0), "abc");
}

TEST(Colours, OfMagnitudesRiseInBrightness) {
  double last = -1.0;
  for (int i = 0; i <= 20; ++i) {
    const std::string hex = magnitude_colour(i / 20.0).value();
    const auto part = [&](int k) {
      return static_cast<double>(
          std::stoi(hex.substr(1 + 2 * static_cast<std::size_t>(k), 2), nullptr, 16));
    };
    const double luminance = 0.2126 * part(0) + 0.7152 * part(1) + 0.0722 * part(2);
    EXPECT_GT(luminance, last) << i;
    last = luminance;
  }
  EXPECT_EQ(signed_colour(0.0).opacity(), 0.0) << "zero is the ground, light or dark";
  EXPECT_EQ(signed_colour(NAN).opacity(), 0.0);
  EXPECT_EQ(signed_colour(-0.5).opacity(), signed_colour(0.5).opacity());
  EXPECT_NE(signed_colour(-0.5).value(), signed_colour(0.5).value());
  EXPECT_EQ(magnitude_colour(NAN).value(), magnitude_colour(0.0).value());
}

}  // namespace
}  // namespace plumb::offline::draw
