// SPDX-License-Identifier: Apache-2.0
#include "arm/known_inputs.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "noise/series_place.hpp"
#include "tests/rt/one_arm.hpp"

namespace plumb::offline {
namespace {

using format::ContextInput;

format::Model arm(std::vector<format::Effect> effects) {
  format::Model model = tests::one_arm();
  model.trees = {};
  model.domain.q_min.assign(6, -1.0);
  model.domain.q_max.assign(6, 1.0);
  model.effects = std::move(effects);
  return model;
}

format::Effect effect(const char* name, std::vector<std::uint8_t> joints,
                      std::vector<format::ContextNeed> context = {}) {
  format::Effect out;
  out.name = name;
  out.joints = std::move(joints);
  out.context = std::move(context);
  return out;
}

const std::vector<double> kInside(6, 0.5);

Status mark(const format::Model& model, const MeasuredContext& at, bool placed) {
  return KnownInputs(model).mark(kInside, at, placed, Status::kOk);
}

TEST(KnownInputs, EachEffectIsMissedWhatItNeeds) {
  struct Case {
    format::Model model;
    void (*tell)(MeasuredContext&);
    const char* column;
  };
  const Case cases[] = {
      {arm({effect("reversal", {1}, {{ContextInput::kDirection, "", 0.0}})}),
       [](MeasuredContext& c) { c.known.direction[1] = 1.0; }, "'dir_j2'"},
      {arm({effect("settling_lag", {2})}), [](MeasuredContext& c) { c.step[2] = 0.5; },
       "'travel_j3'"},
      {arm({effect("thermal_growth", {0}, {{ContextInput::kTemperature, "temp_arm", 21.5}})}),
       [](MeasuredContext& c) { c.known.temperature_degC[0] = 22.0; }, "'temp_arm_degC'"}};
  for (const auto& one : cases) {
    MeasuredContext context;
    KnownInputs inputs(one.model);
    EXPECT_EQ(inputs.mark(kInside, context, true, Status::kOk), Status::kContextFallback);
    one.tell(context);
    EXPECT_EQ(inputs.mark(kInside, context, true, Status::kOk), Status::kOk) << one.column;
    ASSERT_EQ(inputs.remarks().size(), 1u);
    EXPECT_EQ(inputs.remarks()[0].code, "W-PREDICT-INPUT");
    EXPECT_NE(inputs.remarks()[0].message.find(one.column), std::string::npos)
        << inputs.remarks()[0].message;
    EXPECT_NE(inputs.remarks()[0].message.find("1 of 2 rows"), std::string::npos);
  }
}

TEST(KnownInputs, StepAndDriftNeedAPlaceInTheSeries) {
  for (const char* name : {"step", "drift"}) {
    EXPECT_EQ(mark(arm({effect(name, {})}), {}, false), Status::kContextFallback) << name;
    EXPECT_EQ(mark(arm({effect(name, {})}), {}, true), Status::kOk) << name;
  }
}

TEST(KnownInputs, AMissingPayloadMattersWhereSeveralWereFitted) {
  format::Model model = arm({effect("payload_compliance", {1})});
  EXPECT_EQ(mark(model, {}, true), Status::kOk);
  model.domain.context = {{ContextInput::kPayload, "", 0.0, 4.0}};
  EXPECT_EQ(mark(model, {}, true), Status::kContextFallback);
}

TEST(KnownInputs, OutsideIsSaidOnceForAllRowsWithTheFarthestValue) {
  KnownInputs inputs(arm({}));
  std::vector<double> q = kInside;
  for (const double far : {1.2, 2.0, -1.5}) {
    q[3] = far;
    EXPECT_EQ(inputs.mark(q, {}, true, Status::kOk), Status::kOutsideDomain);
  }
  EXPECT_EQ(inputs.mark(kInside, {}, true, Status::kOk), Status::kOk);
  ASSERT_EQ(inputs.remarks().size(), 1u);
  const std::string message = inputs.remarks()[0].message;
  EXPECT_NE(message.find("3 of 4 rows"), std::string::npos) << message;
  EXPECT_NE(message.find("J4 114.6 deg (fitted -57.3 .. 57.3)"), std::string::npos) << message;
}

TEST(KnownInputs, OutsideCountsMoreThanACutAndLessThanARefusal) {
  KnownInputs inputs(arm({effect("step", {})}));
  const std::vector<double> far(6, 3.0);
  EXPECT_EQ(inputs.mark(far, {}, false, Status::kNotConverged), Status::kNotConverged);
  EXPECT_EQ(inputs.mark(far, {}, false, Status::kLimited), Status::kOutsideDomain);
  EXPECT_EQ(inputs.mark(kInside, {}, true, Status::kLimited), Status::kLimited);
}

TEST(TrainedContext, HoldsTheRangesOfWhatTheEffectsRead) {
  format::Model model =
      arm({effect("joint_compliance", {1}),
           effect("thermal_growth", {0}, {{ContextInput::kTemperature, "b", 0}})});
  model.mechanics.payload_kg = 7.0;
  ContextRows rows;
  rows.payload = RowsN::Constant(3, 4, 0.02);
  rows.payload.col(0) << 1.0, kUnknown, 3.0;
  rows.sensors = {"a", "b"};
  rows.temperature.resize(3, 2);
  rows.temperature << 1, 20, 2, kUnknown, 3, 24;
  const auto ranges = trained_context(model, rows);
  ASSERT_EQ(ranges.size(), 11u);
  EXPECT_EQ(ranges[0], (format::ContextRange{ContextInput::kPayload, "", 1.0, 7.0}));
  EXPECT_EQ(ranges[1], (format::ContextRange{ContextInput::kPayload, "cx", 0.02, 0.02}));
  // Nobody pulled at the tool: a wrench is outside.
  EXPECT_EQ(ranges[4], (format::ContextRange{ContextInput::kPayload, "fx", 0.0, 0.0}));
  EXPECT_EQ(ranges[9], (format::ContextRange{ContextInput::kPayload, "mz", 0.0, 0.0}));
  EXPECT_EQ(ranges[10], (format::ContextRange{ContextInput::kTemperature, "b", 20.0, 24.0}));
  EXPECT_TRUE(trained_context(arm({effect("gear_harmonics", {1})}), rows).empty());
  model.effects.erase(model.effects.begin());
  EXPECT_EQ(ranges_read(model, ranges), (std::vector<format::ContextRange>{ranges[10]}));
}

}  // namespace
}  // namespace plumb::offline
