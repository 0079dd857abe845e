// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/effects/joint_table.hpp"

#include <fmt/format.h>

#include <string>

#include "effects/data_rules.hpp"
#include "effects/descriptors.hpp"
#include "plumb/format/limits.hpp"

namespace plumb::offline {
namespace {

Testability joint_table_testable(const DataSense& data) {
  if (data.poses < kManyPoses)
    return cannot_show(poses_text(data) + " for about 100 numbers a joint");
  return data.poses < kDensePoses ? can_show_weakly(poses_text(data)) : can_show(poses_text(data));
}

int joint_table_parameters(int, int) { return effects::JointTable::kEntries; }

std::string joint_table_parameter_name(int place) { return fmt::format("t{:03}", place); }

static_assert(effects::JointTable::kEntries == 120 && format::kMaxParameters == 160,
              "the explanation below states both");

constexpr EffectDescriptor kJointTableDescriptor{
    .name = effects::JointTable::kInfo.name,
    .law = &effects::JointTable::kInfo,
    .explanation =
        "dq as a periodic table of q in steps of 3 degrees: any repeating error of one joint. It "
        "has 120 parameters, and a model file holds 160 in all: name the one joint with --joints. "
        "Needs: dense data over the whole range.",
    .joints = JointList::kSet,
    .testable = joint_table_testable,
    .measure = "500 poses, or one joint swept alone in steps of 2 deg",
    .sentence = "the error of {0} repeats with every turn",
    .search = Search::kNever,
    .cause = Cause::kUnevenGear,
    .joints_apart = true,
    .parameters_of_joint = joint_table_parameters,
    .parameter_name = joint_table_parameter_name,
};

}  // namespace

const EffectDescriptor& law_descriptor(effects::JointTable) { return kJointTableDescriptor; }

}  // namespace plumb::offline
