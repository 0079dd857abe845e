// SPDX-License-Identifier: Apache-2.0
// An arm that grows as it warms up: the model can take that away only while the controller says how
// warm the arm is. CAN FD frames, virtual time.
#include <gtest/gtest.h>

#include "tests/twin/calibrated_twin.hpp"
#include "tests/twin/loop.hpp"
#include "twin/drive.hpp"
#include "twin/tracker.hpp"

namespace plumb::offline::twin {
namespace {

constexpr int kStations = 60;
constexpr double kLongest_s = 600.0;
// Of the readings, in the mean true error. The simulator's column leans as well, by how much it is
// warmer than the air: one sensor does not tell that, and the fit takes it for drift.
constexpr double kLeastGain = 1.8;

const CalibratedTwin& warm() {
  static const CalibratedTwin twin("--hidden thermal_growth=800um");
  return twin;
}

/// As the model counts its own.
const std::vector<std::string> kCounted{"t1", "t2", "t3"};

struct Driven {
  TrueErrors errors;
  Status status = Status::kOk;
};

Driven drive(const CalibratedTwin& twin, const std::vector<Fault>& faults,
             const std::vector<Readings>& along, const std::vector<std::string>& names) {
  const Path path = generated_path(twin.cell(), kStations, 0.5, 7);
  drivers::BusLayout layout = *twin.cell().deploy.bus;
  layout.can_format = drivers::CanFrame::Format::kFd;
  drivers::name_temperatures(names, layout);
  Loop loop(twin.cell(), twin.model(), path, FaultPlan(faults), layout, {}, {});
  loop.controller().feels(along);
  EXPECT_TRUE(loop.run(kLongest_s)) << to_string(loop.session().state());
  return {
      true_errors(twin.cell(), twin.hidden(), twin.truth(), kStations, loop.controller().stops()),
      loop.controller().session().status};
}

std::vector<Readings> readings(const CalibratedTwin& twin, const Hidden& hidden) {
  return readings_along(twin.cell(), hidden, twin.truth(),
                        generated_path(twin.cell(), kStations, 0.5, 7));
}

TEST(Context, AThermalEffectIsCorrectedWithTheTemperaturesAndNotWithout) {
  const CalibratedTwin& twin = warm();
  const auto along = readings(twin, twin.hidden());
  const Driven with = drive(twin, {}, along, kCounted);
  const Driven without = drive(twin, {parse_fault("no-context")}, along, kCounted);
  std::cout << "mean true error with " << 1e6 * with.errors.truth.mean_m << " um, without "
            << 1e6 * without.errors.truth.mean_m << " um\n";
  EXPECT_EQ(with.errors.truth.n, kStations);
  EXPECT_EQ(with.status, Status::kOk);
  EXPECT_EQ(without.status, Status::kContextFallback);
  EXPECT_GT(without.errors.truth.mean_m, kLeastGain * with.errors.truth.mean_m);
}

TEST(Context, SensorsComeInAnyOrderOnABusThatNamesThem) {
  const CalibratedTwin& twin = warm();
  Hidden swapped = twin.hidden();
  std::swap(swapped.sensors[0], swapped.sensors[1]);
  const auto along = readings(twin, twin.hidden()), other = readings(twin, swapped);
  const Driven counted = drive(twin, {}, along, kCounted);
  const Driven wrong = drive(twin, {}, other, kCounted);
  EXPECT_GT(wrong.errors.truth.mean_m, kLeastGain * counted.errors.truth.mean_m);
  EXPECT_EQ(drive(twin, {}, along, swapped.sensors).errors.truth.mean_m,
            counted.errors.truth.mean_m);
  EXPECT_EQ(drive(twin, {}, other, twin.hidden().sensors).errors.truth.mean_m,
            counted.errors.truth.mean_m);
}

TEST(Context, AnArmWarmsUpAlongThePathAndItsReadingsSaySo) {
  const auto along = readings(warm(), warm().hidden());
  ASSERT_EQ(along.size(), static_cast<std::size_t>(kStations));
  double coldest = INFINITY, warmest = -INFINITY;
  for (const Readings& now : along) {
    ASSERT_EQ(now.temperatures.size(), 3U);
    coldest = std::min(coldest, now.temperatures[0].degC);
    warmest = std::max(warmest, now.temperatures[0].degC);
  }
  EXPECT_GT(warmest - coldest, 3.0);
  EXPECT_EQ(along.front().time_s, 0.0);
  EXPECT_GT(along.back().time_s, 3600.0);
}

TEST(Context, EveryValueStandsUnderItsNameAndWhatIsNotKnownIsNoNumber) {
  const auto layout = drivers::default_layout(6, 0.004, 3);
  const Readings now{.payload = {12.0, {0.01, 0.02, 0.03}},
                     .time_s = 60.0,
                     .temperatures = {{"temp", 21.0}, {"temp_room", 22.0}}};
  const auto message = context_message(*layout.find(drivers::MessageKind::kContext), now, 7);
  const double expected[] = {12.0, 0.01, 0.02, 0.03, 60.0, 21.0, 22.0};
  ASSERT_EQ(message.size, 8);
  for (std::size_t i = 0; i < std::size(expected); ++i) EXPECT_EQ(message.values[i], expected[i]);
  EXPECT_TRUE(std::isnan(message.values[7]));
  EXPECT_EQ(message.counter, 7);
}

TEST(Context, ASensorThatTheArmHasNotIsRefused) {
  Hidden hidden = warm().hidden();
  hidden.sensors = {"temp_wrist"};
  try {
    (void)readings(warm(), hidden);
    ADD_FAILURE() << "was taken";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.problems().front().code, "E-TWIN-SENSOR");
  }
}

}  // namespace
}  // namespace plumb::offline::twin
