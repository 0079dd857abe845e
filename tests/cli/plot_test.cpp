// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "sandbox.hpp"

namespace {

/// A cell with one run, made once for all tests that leave it as it is.
class PlotVerb : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    box = new Sandbox;
    ASSERT_EQ(box->plumb({"demo", "compliance", "cell"}).exit, 0);
    ASSERT_EQ(box->plumb({"-C", "cell", "fit"}).exit, 0);
  }
  static void TearDownTestSuite() { delete box; }
  static Ran plot(std::vector<std::string> words) {
    words.insert(words.begin(), {"-C", "cell", "plot"});
    return box->plumb(words);
  }
  static std::string code(const Ran& ran) {
    return ran.json().at("error").at("code").get<std::string>();
  }
  static inline Sandbox* box = nullptr;
};

TEST_F(PlotVerb, DrawsEveryFigureThatItLists) {
  const auto listed = box->plumb({"plot", "--list", "--json"}).json().at("result").at("figures");
  ASSERT_GE(listed.size(), 6U);
  for (const auto& row : listed) {
    auto name = row.at("name").get<std::string>();
    if (const auto at = name.find("JN"); at != std::string::npos) name.replace(at, 2, "J2");
    const Ran ran = plot({name, "-o", name + ".svg"});
    EXPECT_EQ(ran.exit, 0) << name << ran.err;
    const std::string svg = box->read(name + ".svg");
    EXPECT_EQ(svg.rfind("<svg ", 0), 0U) << name;
    EXPECT_EQ(svg.substr(svg.size() - 7), "</svg>\n") << name;
  }
}

TEST_F(PlotVerb, GivesTheSameBytesTwiceAndOthersForAnotherWidth) {
  for (const auto* file : {"one.svg", "two.svg"})
    ASSERT_EQ(plot({"error-hist", "-o", file, "--run", "1"}).exit, 0);
  EXPECT_EQ(box->read("one.svg"), box->read("two.svg"));
  ASSERT_EQ(plot({"error-hist", "-o", "small.svg", "--width", "400"}).exit, 0);
  EXPECT_NE(box->read("small.svg").find("width=\"400\""), std::string::npos);
}

TEST_F(PlotVerb, NamesTheNearestFigureIfThereIsNoneOfThatName) {
  const Ran ran = plot({"error-hits", "--json"});
  EXPECT_EQ(ran.exit, 2);
  EXPECT_EQ(code(ran), "E-PLOT-NAME");
  EXPECT_NE(plot({"error-hits"}).err.find("did you mean: plumb -C cell plot error-hist"),
            std::string::npos);
  EXPECT_EQ(plot({"joint-J9"}).exit, 2) << "an arm of six joints";
  EXPECT_EQ(plot({}).exit, 2);
}

TEST_F(PlotVerb, KeepsAFileThatIsThereUnlessForced) {
  box->write("kept.svg", "mine");
  EXPECT_EQ(plot({"error-hist", "-o", "kept.svg"}).exit, 2);
  EXPECT_EQ(plot({"error-hist", "-o", "kept.svg", "--force", "--dry-run"}).exit, 0);
  EXPECT_EQ(box->read("kept.svg"), "mine");
  EXPECT_EQ(plot({"error-hist", "-o", "kept.svg", "--force"}).exit, 0);
  EXPECT_NE(box->read("kept.svg"), "mine");
}

TEST_F(PlotVerb, SaysWhatIsMissingAndWritesNothing) {
  EXPECT_EQ(plot({"error-hist", "-o", "new.svg", "--run", "99"}).exit, 3);
  EXPECT_EQ(plot({"error-hist", "-o", "new.svg", "--run", "last"}).exit, 2);
  EXPECT_EQ(plot({"error-hist", "-o", "/proc/nowhere/x.svg"}).exit, 5);
  EXPECT_EQ(plot({"error-hist", "-o", "new.svg", "--width", "10"}).exit, 2);
  const Sandbox fresh;
  ASSERT_EQ(fresh.plumb({"demo", "clean", "cell"}).exit, 0);
  const Ran ran = fresh.plumb({"-C", "cell", "plot", "error-hist", "--json"});
  EXPECT_EQ(ran.exit, 3);
  EXPECT_EQ(code(ran), "E-PLOT-RUN");
  for (const auto& file : fresh.listing()) EXPECT_EQ(file.find(".svg"), std::string::npos) << file;
}

TEST(Plot, OfACellWithoutMeasurementsOrRunGivesOneMessageForEveryFigure) {
  const Sandbox box;
  ASSERT_EQ(box.plumb({"demo", "scara", "cell"}).exit, 0);
  const std::string rows = box.read("cell/measurements.csv");
  const std::string head = rows.substr(0, rows.find("\nP") + 1);
  const auto listed = box.plumb({"plot", "--list", "--json"}).json().at("result").at("figures");
  for (const std::string& data : {head, rows}) {
    box.write("cell/measurements.csv", data);
    for (const auto& row : listed) {
      auto name = row.at("name").get<std::string>();
      if (name == "evidence" && data == rows) continue;  // needs no run
      if (const auto at = name.find("JN"); at != std::string::npos) name.replace(at, 2, "J2");
      const Ran ran = box.plumb({"-C", "cell", "plot", name, "--json"});
      EXPECT_EQ(ran.exit, 3) << name << ran.err;
      EXPECT_EQ(ran.json().at("error").at("code").get<std::string>().rfind("E-", 0), 0U) << name;
    }
  }
  for (const auto& file : box.listing()) EXPECT_EQ(file.find(".svg"), std::string::npos) << file;
}

}  // namespace
