// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdlib>
#include <regex>
#include <set>

#include "sandbox.hpp"

namespace {

using Words = std::vector<std::string>;

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

/// The text of one section of a report.
std::string section(const std::string& html, const std::string& id) {
  const auto from = html.find("<section id=\"" + id + "\"");
  return from == std::string::npos ? "" : html.substr(from, html.find("</section>", from) - from);
}

std::string code(const Ran& ran) { return ran.json().at("error").at("code").get<std::string>(); }

bool wrote_a_page(const Sandbox& box) {
  for (const auto& file : box.listing())
    if (file.ends_with(".html") || file.ends_with(".pdf")) return true;
  return false;
}

/// A cell of so many axes with simulated measurements.
void make_cell(const Sandbox& box, int axes, const std::string& poses) {
  std::string dh = "joint,alpha_deg,a_mm,d_mm,theta_deg\n";
  for (int j = 1; j <= axes; ++j)
    dh += "J" + std::to_string(j) + (j % 2 == 0 && axes > 2 ? ",90," : ",0,") +
          std::to_string(400 - 30 * j) + "," + (axes > 2 ? "100" : "0") + ",0\n";
  box.write("dh.csv", dh);
  ASSERT_EQ(box.plumb({"new", "cell", "--dh", "dh.csv", "--convention", "standard"}).exit, 0);
  const Ran made = box.plumb({"-C", "cell", "simulate", "--poses", poses});
  ASSERT_EQ(made.exit, 0) << made.err;
}

/// The verb in a small cell that has been reported once, for all tests that leave it as it is.
class ReportVerb : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    box = new Sandbox;
    ASSERT_NO_FATAL_FAILURE(make_cell(*box, 3, "40"));
    first = report({"-o", "first.html", "--json"});
    ASSERT_EQ(first.exit, 0) << first.err;
    html = box->read("first.html");
  }
  static void TearDownTestSuite() { delete box; }
  static Ran report(Words words) {
    words.insert(words.begin(), {"-C", "cell", "report"});
    return box->plumb(words);
  }
  static inline Sandbox* box = nullptr;
  static inline Ran first;
  static inline std::string html;
};

TEST_F(ReportVerb, FitsFirstAndSaysWhatItWrote) {
  const auto result = first.json().at("result");
  EXPECT_EQ(result.at("report"), "first.html");
  EXPECT_EQ(result.at("bytes"), html.size());
  EXPECT_EQ(result.at("pages"), 11);
  EXPECT_EQ(result.at("run"), 1);
  EXPECT_TRUE(result.at("good").is_boolean());
  EXPECT_TRUE(result.at("pdf").is_null());
  EXPECT_EQ(result.at("diagnosis"), "new");
  EXPECT_LT(html.size(), 2'000'000U);
}

TEST_F(ReportVerb, NeedsNothingButItself) {
  for (const auto* loaded : {"<script", "src=", "@import", "url(", "<link rel=\"stylesheet\""})
    EXPECT_EQ(html.find(loaded), std::string::npos) << loaded;
  EXPECT_EQ(count(html, "http"),
            count(html, "xmlns=\"http://www.w3.org/2000/svg\"") + count(html, "http-equiv"));
  EXPECT_EQ(count(html, "<style>"), 1U) << "figures share one";
}

TEST_F(ReportVerb, HasElevenPagesWithIdsThatOccurOnce) {
  EXPECT_EQ(count(html, "<section "), 11U);
  std::set<std::string> ids;
  const std::regex id("\\sid=\"([^\"]*)\"");
  for (std::sregex_iterator it(html.begin(), html.end(), id), end; it != end; ++it)
    EXPECT_TRUE(ids.insert((*it)[1]).second) << (*it)[1];
  EXPECT_GE(ids.size(), 22U);
  for (const auto* number : {"nan", "inf"})
    EXPECT_FALSE(std::regex_search(html, std::regex("[ >\"]-?" + std::string(number) + "[ <\"]")));
}

TEST_F(ReportVerb, SaysInTheGlossaryOnlyWhatOccurs) {
  const std::string glossary = section(html, "glossary");
  EXPECT_NE(glossary.find("<dt>noise floor</dt>"), std::string::npos);
  EXPECT_EQ(glossary.find("<dt>ramping</dt>"), std::string::npos);
  EXPECT_EQ(glossary.find("<dt>hysteresis</dt>"), std::string::npos);
}

TEST_F(ReportVerb, UsesWhatADiagnosisFoundBefore) {
  EXPECT_EQ(report({"--json", "--dry-run"}).json().at("result").at("diagnosis"), "kept");
  const std::string kept = box->read("cell/runs/0001/diagnosis.json");
  box->write("cell/runs/0001/diagnosis.json",
             replaced(kept, "\"nested\": false", "\"nested\": true"));
  const auto again = report({"--json", "--dry-run"}).json().at("result").at("diagnosis");
  EXPECT_EQ(again, kept.find("\"nested\": false") == std::string::npos ? "kept" : "new");
  box->write("cell/runs/0001/diagnosis.json", kept.substr(0, kept.size() / 2));
  EXPECT_EQ(report({"--json", "--dry-run"}).json().at("result").at("diagnosis"), "new");
  box->write("cell/runs/0001/diagnosis.json", kept);
}

TEST_F(ReportVerb, WritesAllOrNothing) {
  box->write("mine.html", "mine");
  EXPECT_EQ(report({"-o", "mine.html"}).exit, 2);
  EXPECT_EQ(report({"-o", "mine.html", "--force", "--dry-run"}).exit, 0);
  EXPECT_EQ(box->read("mine.html"), "mine");
  EXPECT_EQ(report({"-o", "mine.html", "--force"}).exit, 0);
  EXPECT_NE(box->read("mine.html"), "mine");
  const Ran full = report({"-o", "/dev/full", "--json"});
  EXPECT_EQ(full.exit, 5);
  EXPECT_EQ(code(full), "E-WRITE");
  EXPECT_EQ(report({"-o", "/proc/nowhere/x.html"}).exit, 5);
  EXPECT_EQ(report({"--run", "99"}).exit, 3);
  EXPECT_EQ(report({"--run", "last"}).exit, 2);
}

/// PATH as long as it lives.
class Path {
 public:
  explicit Path(const std::string& path) : before_(std::getenv("PATH")) {
    ::setenv("PATH", path.c_str(), 1);
  }
  ~Path() { ::setenv("PATH", before_.c_str(), 1); }
  Path(const Path&) = delete;
  Path& operator=(const Path&) = delete;

 private:
  std::string before_;
};

TEST_F(ReportVerb, PrintsWithTheBrowserThatIsThereAndElseWritesNothing) {
  const auto bin = box->path() / "bin";
  const Path path(bin.string());
  const Ran none = report({"-o", "p.html", "--pdf", "--json"});
  EXPECT_EQ(none.exit, 5);
  EXPECT_EQ(code(none), "E-REPORT-BROWSER");
  const auto browser = [&](const std::string& script) {
    std::filesystem::create_directories(bin);
    box->write("bin/chromium", "#!/bin/sh\n" + script);
    std::filesystem::permissions(bin / "chromium", std::filesystem::perms::owner_all);
  };
  browser("exit 3\n");
  const Ran broken = report({"-o", "p.html", "--pdf", "--json"});
  EXPECT_EQ(broken.exit, 5);
  EXPECT_EQ(code(broken), "E-REPORT-PDF");
  EXPECT_FALSE(std::filesystem::exists(box->path() / "p.html"));
  browser("for a; do case $a in --print-to-pdf=*) echo printed > ${a#*=};; esac; done\n");
  const Ran made = report({"-o", "p.html", "--pdf", "--json"});
  EXPECT_EQ(made.json().at("result").at("pdf"), "p.pdf") << made.err;
  EXPECT_EQ(box->read("p.pdf"), "printed\n");
}

TEST(Report, SaysOnItsFirstPageThatACellIsNotGood) {
  const Sandbox box;
  ASSERT_NO_FATAL_FAILURE(make_cell(box, 2, "30"));
  const std::string cell = box.read("cell/cell.toml");
  box.write("cell/cell.toml",
            std::regex_replace(cell, std::regex("tolerance_mm = [0-9.]+"), "tolerance_mm = 0.001"));
  const Ran ran = box.plumb({"-C", "cell", "report", "--json"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_EQ(ran.json().at("result").at("good"), false);
  const std::string first = section(box.read("report.html"), "verdict");
  EXPECT_NE(first.find("class=\"verdict bad\""), std::string::npos);
  EXPECT_NE(first.find("Not good"), std::string::npos);
}

TEST(Report, IsWrittenAtOnceWithoutADiagnosisAndSaysSo) {
  const Sandbox box;
  ASSERT_NO_FATAL_FAILURE(make_cell(box, 2, "30"));
  const Ran ran = box.plumb({"-C", "cell", "report", "--no-diagnosis", "--json"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_TRUE(ran.json().at("result").at("diagnosis").is_null());
  const std::string html = box.read("report.html");
  EXPECT_NE(section(html, "missing").find("Not diagnosed"), std::string::npos);
  EXPECT_NE(section(html, "reproduce").find("--no-diagnosis"), std::string::npos);
  EXPECT_EQ(html.find("do not say the"), std::string::npos) << "a figure with nothing in it";
  EXPECT_EQ(html.find("data-pose"), std::string::npos);
}

TEST(Report, ListsAReadingOnceThatStandsOutAsFittedAndAsHeldOut) {
  const Sandbox box;
  ASSERT_EQ(box.plumb({"demo", "mixed", "cell"}).exit, 0);
  const Ran ran = box.plumb({"-C", "cell", "report", "--no-diagnosis"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const std::string data = section(box.read("report.html"), "data");
  EXPECT_EQ(count(data, "<th scope=\"row\">P109</th>"), 1U) << "in folds it is both";
  EXPECT_NE(data.find("left out of the fit and of the verdict"), std::string::npos);
}

TEST(Report, TellsWhatIsAssumedAndWhatIsUnknown) {
  const Sandbox box;
  ASSERT_NO_FATAL_FAILURE(make_cell(box, 9, "60"));
  box.write("cell/cell.toml", std::regex_replace(box.read("cell/cell.toml"),
                                                 std::regex("\ntolerance_mm = [^\n]*"), ""));
  const Ran ran = box.plumb({"-C", "cell", "report", "--json"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_NE(section(box.read("report.html"), "verdict").find("states no tolerance"),
            std::string::npos);
}

TEST(Report, WithoutARunThatCanBeMadeWritesNothing) {
  const Sandbox box;
  ASSERT_NO_FATAL_FAILURE(make_cell(box, 2, "30"));
  const std::string cell = box.read("cell/cell.toml"), rows = box.read("cell/measurements.csv");
  box.write("cell/cell.toml",
            std::regex_replace(cell, std::regex("held_out = \"[^\"]*\""),
                               "held_out = \"column:set\""));  // and no row is marked as held
  EXPECT_EQ(box.plumb({"-C", "cell", "report"}).exit, 3);
  box.write("cell/cell.toml", cell);
  const auto second = rows.find("\nP002");
  ASSERT_NE(second, std::string::npos);
  box.write("cell/measurements.csv", rows.substr(0, second + 1));
  EXPECT_EQ(box.plumb({"-C", "cell", "report"}).exit, 3) << "one pose";
  EXPECT_FALSE(wrote_a_page(box));
}

TEST(Report, EscapesEveryNameAndShowsAFormula) {
  const Sandbox box;
  ASSERT_NO_FATAL_FAILURE(make_cell(box, 2, "30"));
  const std::string evil = "<script>alert('x')</script>";
  std::string cell =
      std::regex_replace(box.read("cell/cell.toml"), std::regex("\nname = \"[^\"]*\""),
                         "\nname = \"" + evil + "&\\\\\\\"\"");
  box.write("cell/cell.toml", cell);
  box.write("cell/measurements.csv",
            std::regex_replace(box.read("cell/measurements.csv"), std::regex("\nP0*([0-9]+),"),
                               "\n</title><svg onload=x>$1<script>,"));
  const Ran added = box.plumb({"-C", "cell", "add", "formula", "--formula", "dq1 = k * sin(q1)",
                               "--parameter", "k [rad] ~ 1e-4"});
  ASSERT_EQ(added.exit, 0) << added.err;
  const Ran ran = box.plumb({"-C", "cell", "report"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const std::string html = box.read("report.html");
  EXPECT_EQ(html.find("<script"), std::string::npos);
  EXPECT_EQ(html.find("<svg onload"), std::string::npos);
  EXPECT_NE(html.find("&lt;script&gt;"), std::string::npos);
  EXPECT_NE(section(html, "reproduce").find("sin(q1)"), std::string::npos);
}

// One truth: fit, compare and the report give one verdict, one class, one floor, one held-out
// figure.
TEST(OneVerdict, IsThatOfEveryMedium) {
  const Sandbox box;
  for (const char* demo : {"clean", "compliance", "mixed", "thermal", "scara", "unknown"}) {
    const std::string cell = demo;
    ASSERT_EQ(box.plumb({"demo", demo, cell}).exit, 0);
    for (const char* tolerance : {"tolerance_mm = 0.02 #", "tolerance_mm = 5 #"}) {
      std::string text = box.read(cell + "/cell.toml");
      const auto at = text.find("tolerance_mm = ");
      ASSERT_NE(at, std::string::npos);
      text.replace(at, std::string("tolerance_mm = ").size(), tolerance);
      box.write(cell + "/cell.toml", text);
      const auto fit = box.plumb({"-C", cell, "fit", "--json"}).json()["result"];
      const auto compare = box.plumb({"-C", cell, "compare", "--json"}).json()["result"];
      for (const char* key : {"verdict", "verdict_head", "verdict_class", "noise_floor_mm"})
        EXPECT_EQ(fit[key], compare[key]) << cell << " " << key;
      EXPECT_EQ(fit["held_out"]["mean_mm"], compare["mean_mm"]) << cell;
      const std::string head = fit["verdict_head"], found = fit["verdict_class"];
      const std::string sentence = fit["verdict"];
      EXPECT_EQ(box.plumb({"-C", cell, "fit"}).out.rfind(sentence, 0), 0U) << cell;
      const Ran report =
          box.plumb({"-C", cell, "report", "-o", "r.html", "--force", "--no-diagnosis", "--json"});
      ASSERT_EQ(report.exit, 0) << report.out;
      EXPECT_EQ(report.json()["result"]["verdict"], sentence);
      const std::string html = box.read("r.html");
      EXPECT_NE(html.find("<div class=\"verdict " + found + "\""), std::string::npos) << cell;
      EXPECT_NE(html.find(" " + head + "</strong>"), std::string::npos) << cell << head;
    }
  }
}

}  // namespace
