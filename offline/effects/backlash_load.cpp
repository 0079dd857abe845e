// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/effects/backlash_load.hpp"

#include "effects/data_rules.hpp"
#include "effects/descriptors.hpp"
#include "effects/torque_constant.hpp"

namespace plumb::offline {
namespace {

Testability backlash_load_testable(const DataSense& data) {
  if (loaded_joints(data).empty()) return cannot_show("no joint carries a load that varies");
  return data.has_masses
             ? can_show("loads change with the pose")
             : can_show_weakly("masses unknown, so it is not known where the load changes side");
}

constexpr EffectDescriptor kBacklashLoadDescriptor{
    .name = effects::BacklashLoad::kInfo.name,
    .law = &effects::BacklashLoad::kInfo,
    .explanation =
        "The gear's play is taken up by the load: dq = b/2 tanh(tau/tau0). Typical: 30 to 290 "
        "urad. Needs: masses and payload.",
    .options = kTorqueOptions,
    .joints = JointList::kSet,
    .testable = backlash_load_testable,
    .measure = "masses in cell.toml; poses on both sides of the balance",
    .sentence = "the load takes up the play in the gear of {0}",
    .search = Search::kGrid,
    .candidate_joints = CandidateJoints::kEach,
    .grid = kTorqueGrid,
    .refinement = &kTorqueRefinement,
    .turns_listed_joint_only = true,
    .once_a_joint = true,
    .joints_apart = true,
    .bind = bind_torque_constant,
};

}  // namespace

const EffectDescriptor& law_descriptor(effects::BacklashLoad) { return kBacklashLoadDescriptor; }

}  // namespace plumb::offline
