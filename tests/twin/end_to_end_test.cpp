// SPDX-License-Identifier: Apache-2.0
// The whole way in one process and in virtual time: an arm that hides something is measured by its
// tracker, diagnosed, compiled, and corrected by plumb-rt's session over CAN frames.
#include <gtest/gtest.h>

#include "tests/twin/calibrated_twin.hpp"
#include "tests/twin/loop.hpp"
#include "twin/drive.hpp"
#include "twin/tracker.hpp"

namespace plumb::offline::twin {
namespace {

constexpr int kStations = 500;
constexpr double kLongest_s = 3600.0;

using drivers::CorrectionForm;

drivers::BusLayout layout_of(const Cell& cell, drivers::CanFrame::Format format,
                             CorrectionForm form) {
  auto out = drivers::default_layout(cell.joints(), cell.deploy.cycle_s, 0, form);
  out.can_format = format;
  return out;
}

Comparison compare(const CalibratedTwin& twin, const Path& path, const ControllerSettings& settings,
                   const std::vector<Stop>& corrected) {
  Comparison out;
  out.off = true_errors(twin.cell(), twin.hidden(), twin.truth(), path.stations(),
                        drive_uncorrected(twin.cell(), path, settings));
  out.on = true_errors(twin.cell(), twin.hidden(), twin.truth(), path.stations(), corrected);
  out.floor = floor_of(twin.hidden().noise_m);
  for (const Stop& stop : corrected) out.unsettled += stop.settled ? 0 : 1;
  return out;
}

void expect_true(const CalibratedTwin& twin, drivers::CanFrame::Format format,
                 CorrectionForm form = CorrectionForm::kPose) {
  const Path path = generated_path(twin.cell(), kStations, 0.5, 7);
  const ControllerSettings settings;
  Loop loop(twin.cell(), twin.model(), path, {}, layout_of(twin.cell(), format, form), {},
            settings);
  ASSERT_TRUE(loop.run(kLongest_s)) << to_string(loop.session().state());
  const Comparison found = compare(twin, path, settings, loop.controller().stops());
  std::cout << to_text(found) << "  " << loop.now_s() << " s of virtual time\n";
  EXPECT_EQ(found.on.truth.n, kStations);
  EXPECT_GE(found.ratio(), kLeastRatio);
  EXPECT_LT(found.on.measured.mean_m, kMostOverFloor * found.floor.mean_m);
  EXPECT_LT(found.on.measured.rms_m, kMostOverFloor * found.floor.rms_m);
  EXPECT_LT(found.on.truth.mean_m, kMostOverFloor * twin.hidden().noise_m);
  EXPECT_TRUE(found.reached());
  EXPECT_EQ(found.unsettled, 0);
  EXPECT_EQ(loop.controller().counters().no_inverse, 0U);
  EXPECT_LE(loop.controller().counters().largest_step_m,
            settings.receiver.slew_m_per_s * settings.cycle_s * 1.0001);
}

TEST(EndToEnd, OverClassicCanTheTrueErrorFallsFiveTimesAndToTheTrackersNoise) {
  expect_true(CalibratedTwin::usual(), drivers::CanFrame::Format::kClassic);
}

TEST(EndToEnd, OverCanFdTheTrueErrorFallsFiveTimesAndToTheTrackersNoise) {
  expect_true(CalibratedTwin::usual(), drivers::CanFrame::Format::kFd);
}

TEST(EndToEnd, AsOffsetsOverClassicCanTheTrueErrorKeepsTheSameBounds) {
  expect_true(CalibratedTwin::usual(), drivers::CanFrame::Format::kClassic,
              CorrectionForm::kOffset);
}

TEST(EndToEnd, AsOffsetsOverCanFdTheTrueErrorKeepsTheSameBounds) {
  expect_true(CalibratedTwin::usual(), drivers::CanFrame::Format::kFd, CorrectionForm::kOffset);
}

TEST(EndToEnd, AModelOfAnotherArmDoesNotPassForATrueOne) {
  const auto& twin = CalibratedTwin::usual();
  const CalibratedTwin other("--seed 2");
  Cell cell = twin.cell();
  cell.serial = other.cell().serial;  // or it would not even be let in
  const Path path = generated_path(cell, 40, 0.5, 7);
  const ControllerSettings settings;
  const auto layout = layout_of(cell, drivers::CanFrame::Format::kFd, CorrectionForm::kPose);
  Loop loop(cell, other.model(), path, {}, layout, {}, settings);
  ASSERT_TRUE(loop.run(kLongest_s));
  EXPECT_FALSE(compare(twin, path, settings, loop.controller().stops()).reached());
}

}  // namespace
}  // namespace plumb::offline::twin
