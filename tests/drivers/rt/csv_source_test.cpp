// SPDX-License-Identifier: Apache-2.0
#include "rt/csv_source.hpp"

#include <gtest/gtest.h>

#include "rt/deployment.hpp"
#include "tests/drivers/deployed.hpp"
#include "tests/drivers/rt/problem_of.hpp"

namespace plumb::drivers::rt {
namespace {

std::shared_ptr<const BusSource> read_source(const std::string& text) {
  TomlSource source("rt.toml", text, "E-RT");
  const toml::table parsed = source.parse();
  TomlTable table(parsed, "source", source);
  auto out = CsvSource::read(table, "/deploy");
  table.done();
  source.stop_on_errors();
  return out;
}

/// The cycles that the bus of a deployment plays before it has no more.
int cycles_of(const Deployment& deployment) {
  const BusLayout record = record_layout(deployment);
  const auto bus = deployment.config.source->open({.layout = deployment.layout,
                                                   .record_layout = record,
                                                   .model = *deployment.model.loaded,
                                                   .session = deployment.session});
  int out = 0;
  for (; !bus->finished() && out < 1'000'000; ++out)
    for (BusMessage message; bus->port().receive(message);) {
    }
  return out;
}

TEST(CsvSource, ItsFileLiesInTheDeployFolderAndMustBeNamed) {
  const auto source = read_source("file = \"below/targets.csv\"\n");
  const auto* const csv = dynamic_cast<const CsvSource*>(source.get());
  ASSERT_NE(csv, nullptr);
  EXPECT_EQ(csv->file, "/deploy/below/targets.csv");
  for (const char* const text : {"", "file = \"\"\n"}) {
    const Problem problem = tests::problem_of([&] { std::ignore = read_source(text); });
    EXPECT_EQ(problem.code, "E-RT-MISSING") << text;
    EXPECT_NE(problem.message.find("source.file"), std::string::npos) << problem.message;
  }
}

TEST(CsvSource, NoRobotMovesAndNobodyElseCanSendOnIt) {
  const auto source = read_source("file = \"targets.csv\"\n");
  EXPECT_FALSE(source->has_robot());
  EXPECT_EQ(source->endpoint().kind, BusEndpoint::Kind::kNone);
}

/// The session needs time to compare poses, to wait and to ramp in: a target that it does not
/// correct is a line that is missing in the answers.
TEST(CsvSource, ALongerRampGivesTheSessionMoreCyclesBeforeTheFirstTarget) {
  const tests::Deployed folder, slow;
  format::Model model = tests::Deployed::arm();
  model.guard.ramp_s += 1.0;
  slow.write_model("robot.plumb", model);
  const int usual = cycles_of(load_deployment(folder.folder));
  const Deployment other = load_deployment(slow.folder);
  EXPECT_GE(usual, tests::Deployed::kTargets + other.session.sync.poses);
  const double longer_s = (cycles_of(other) - usual) * other.session.cycle_s;
  EXPECT_NEAR(longer_s, 2.0, 0.01) << "out and in again";
}

TEST(CsvSource, AFileOfTargetsThatCannotBeReadIsRefusedWhenItIsOpened) {
  const tests::Deployed folder;
  const Deployment deployment = load_deployment(folder.folder);
  std::ofstream(folder.folder / "targets.csv") << "x_mm,y_mm,z_mm\n1,2,3\n";
  EXPECT_EQ(tests::problem_of([&] { std::ignore = cycles_of(deployment); }).code, "E-RT-CSV");
  std::filesystem::remove(folder.folder / "targets.csv");
  EXPECT_EQ(tests::problem_of([&] { std::ignore = cycles_of(deployment); }).code.substr(0, 6),
            "E-READ");
}

}  // namespace
}  // namespace plumb::drivers::rt
