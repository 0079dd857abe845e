// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/effects/joint_series.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "effects/data_rules.hpp"
#include "effects/descriptors.hpp"

namespace plumb::offline {
namespace {

// If the cell states none.
constexpr double kUsualWaves = 20.0, kUsualSize_urad = 100.0, kUsualSlope = 1.0;

static_assert(format::kMaxSeriesWaves == 64, "a rule and the explanation below state it");

constexpr EffectOption kJointSeriesOptions[] = {
    {.key = OptionKey::kWaves,
     .takes = EffectOption::Takes::kWhole,
     .rule = "a whole number from 1 to 64",
     .example = "40",
     .least = 1.0,
     .most = static_cast<double>(format::kMaxSeriesWaves)},
    {.key = OptionKey::kSize_urad,
     .rule = "a number greater than 0, at most 5000",
     .example = "100",
     .above = 0.0,
     .most = 5000.0},
    {.key = OptionKey::kSlope,
     .rule = "a number from 0 to 4",
     .example = "1",
     .least = 0.0,
     .most = 4.0},
};

Testability joint_series_testable(const DataSense& data) {
  if (data.poses < kManyPoses)
    return cannot_show(poses_text(data) + " for dozens of numbers a joint");
  const std::string wide = joint_list(data, [&](int j) { return data.range[j] >= kWideRange_rad; });
  if (wide.empty()) return cannot_show("no joint moves by 60 deg");
  return data.poses < kDensePoses ? can_show_weakly(poses_text(data)) : can_show(poses_text(data));
}

void bind_joint_series(const EffectEntry& entry, const ConstantsSource&, format::Effect& out) {
  out.constants = {number_option(entry, OptionKey::kWaves, kUsualWaves),
                   number_option(entry, OptionKey::kSize_urad, kUsualSize_urad) * 1e-6,
                   number_option(entry, OptionKey::kSlope, kUsualSlope)};
}

/// 1 sigma of wave k: size k^-slope.
double joint_series_typical(const format::Effect& effect, int place) {
  return effect.constants[1] * std::pow(place / 2 + 1, -effect.constants[2]);
}

std::string joint_series_parameter_name(int place) {
  return fmt::format("{}{}", place % 2 == 0 ? "sin" : "cos", place / 2 + 1);
}

constexpr EffectDescriptor kJointSeriesDescriptor{
    .name = effects::JointSeries::kInfo.name,
    .law = &effects::JointSeries::kInfo,
    .explanation =
        "dq as a series of whole waves of the joint's turn, k = 1 to 64 at most: any error that "
        "repeats with every turn. Its numbers are held near 0, with a standard deviation of "
        "size_urad times k to the power of -slope; diagnose chooses both by the evidence, and "
        "names the largest waves. It takes the place of many single waves. Needs: dense data over "
        "the joint's range.",
    .options = kJointSeriesOptions,
    .joints = JointList::kSet,
    .testable = joint_series_testable,
    .measure = "500 poses not on a grid, over the whole range of the joint",
    .sentence = "the error of {0} repeats with every turn",
    .search = Search::kSeries,
    .turns_listed_joint_only = true,
    .once_a_joint = true,
    .cause = Cause::kUnevenGear,
    .joints_apart = true,
    .bind = bind_joint_series,
    .prior_width = 1.0,
    .prior_tail = PriorTail::kNormal,
    .typical = joint_series_typical,
    .parameter_name = joint_series_parameter_name,
};

}  // namespace

const EffectDescriptor& law_descriptor(effects::JointSeries) { return kJointSeriesDescriptor; }

}  // namespace plumb::offline
