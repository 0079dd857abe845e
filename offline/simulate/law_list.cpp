// SPDX-License-Identifier: Apache-2.0
#include "simulate/law_list.hpp"
#include "simulate/law_entry.hpp"

#include <algorithm>

namespace plumb::offline::sim {
namespace {

using Size = LawEntry::Size;
using Domain = LawEntry::Domain;
using Needs = LawEntry::Needs;

void add_gravity_laws(std::vector<LawEntry>& all) {
  all.push_back(
      like(of_joints("joint_compliance",
                     "joints yield under gravity, softer at high load; size: largest angle",
                     make_joint_compliance),
           {"gravity_free", "joint_compliance_soft"}));
  all.push_back(like(of_joints("joint_compliance_soft",
                               "joints soft at small torque, stiffer beyond; size: largest angle",
                               make_soft_joint_compliance),
                     {"joint_compliance", "backlash_load", "gravity_free"}));
  all.push_back(with_keys(
      of_joints("cross_compliance", "a joint yields to the torque of another one; @from=2",
                make_cross_compliance),
      {"from"}));
  all.push_back(like(
      of_joints("payload_compliance", "joints yield to the payload only", make_payload_compliance),
      {"wrench_compliance"}));
  all.push_back(like(of_joints("backlash_load",
                               "teeth change flank with the torque; size: half gap", make_backlash),
                     {"joint_compliance_soft"}));
  all.push_back(like(of_joints("gravity_compensator", "balancing spring of J2; size: largest angle",
                               make_gravity_compensator),
                     {"gear_harmonics", "encoder_eccentricity", "joint_table"}));
  all.push_back(of_joints("link_flexure",
                          "links bend as tapered beams; size: largest rotation of the link's end",
                          make_link_flexure));
  all.push_back(of_arm("base_compliance", "the base plate tilts; size: largest angle", Size::kAngle,
                       Domain::kRobot, make_base_compliance));
  all.push_back(of_arm("tool_sag", "the tool hangs on a soft coupling; size: largest shift",
                       Size::kLength, Domain::kRobot, make_tool_sag));
}

void add_joint_laws(std::vector<LawEntry>& all) {
  all.push_back(
      like(of_joints("gear_harmonics",
                     "once, twice and a little thrice per turn, more under load; size: first",
                     make_gear_harmonics),
           {"encoder_eccentricity", "gravity_compensator", "joint_table"}));
  all.push_back(
      with_keys(like(of_joints("gear_ripple", "many cycles a turn with sidebands; @cycles=20",
                               make_gear_ripple),
                     {"gear_harmonics"}),
                {"cycles"}));
  all.push_back(like(of_joints("joint_table", "any periodic error of a joint and one worn tooth",
                               make_joint_table),
                     {"gear_harmonics", "gear_ripple", "joint_series"}));
  all.push_back(of_joints("encoder_scale", "a wrong number of increments; size: error a radian",
                          make_encoder_scale));
  all.push_back(like(of_joints("encoder_eccentricity", "code wheel beside its axis; size: in radii",
                               make_encoder_eccentricity),
                     {"gear_harmonics", "gravity_compensator", "joint_table"}));
  all.push_back(of_joints("axis_wobble",
                          "axis tilts and runs out once and twice a turn; size: tilt",
                          make_axis_wobble));
  all.push_back(of_arm("wrist_coupling", "wrist gears drive one another; size: error a radian",
                       Size::kAngle, Domain::kRobot, make_wrist_coupling));
}

void add_history_laws(std::vector<LawEntry>& all) {
  all.push_back(needing(
      of_joints("reversal", "joints stop short by the side they come from; size: half the gap",
                make_reversal),
      Needs::kDirection));
  all.push_back(needing(
      during(of_joints("settling_lag", "joints were read before standstill", make_settling_lag),
             Domain::kProcedure),
      Needs::kDirection));
  all.push_back(needing(of_arm("thermal_growth", "links grow, the column tilts; size: arm, 10 K",
                               Size::kLength, Domain::kEnvironment, make_thermal_growth),
                        Needs::kTemperature));
  all.push_back(of_arm("drift",
                       "the base moves slowly against the tracker; size: shift in the first hour",
                       Size::kLength, Domain::kMeasurement, make_drift));
  all.push_back(
      with_keys(called(of_arm("step_reflector", "the reflector slips; @at=0.5 of the time",
                              Size::kLength, Domain::kMeasurement, make_step_reflector),
                       "step"),
                {"at", "at_s"}));
  all.push_back(with_keys(called(of_arm("step_base", "the tracker is pushed; @at=0.5 of the time",
                                        Size::kLength, Domain::kMeasurement, make_step_base),
                                 "step"),
                          {"at", "at_s"}));
  all.push_back(
      with_keys(called(during(of_joints("step_encoder", "an encoder slips; @at=0.5 of the time",
                                        make_step_encoder),
                              Domain::kMeasurement),
                       "step"),
                {"at", "at_s"}));
  all.push_back(of_arm("tracker", "radial offset, scale, errors of its angles; size: radial offset",
                       Size::kLength, Domain::kMeasurement, make_tracker));
}

/// What the first part of the blind study does not draw, so that its cases remain what they were.
void add_inconvenient_laws(std::vector<LawEntry>& all) {
  all.push_back(needing(called(of_joints("overcompensated_reversal",
                                         "a controller takes out more backlash than there is",
                                         make_overcompensated_reversal),
                               "reversal"),
                        Needs::kDirection));
  all.push_back(
      with_keys(called(of_arm("two_steps_reflector", "the reflector slips twice; size: each slip",
                              Size::kLength, Domain::kMeasurement, make_two_steps_reflector),
                       "step"),
                {"at_s", "at2_s"}));
  all.push_back(
      with_keys(called(of_arm("two_steps_base", "the tracker is pushed twice; size: each push",
                              Size::kLength, Domain::kMeasurement, make_two_steps_base),
                       "step"),
                {"at_s", "at2_s"}));
}

void add_unknown_laws(std::vector<LawEntry>& all) {
  const auto unknown = [](LawEntry entry) { return called(std::move(entry), "unknown"); };
  all.push_back(
      needing(like(unknown(of_joints("dress_pack", "hoses wind up and rub on a wrist joint",
                                     make_dress_pack)),
                   {"joint_table", "gear_harmonics", "encoder_scale", "reversal"}),
              Needs::kDirection));
  all.push_back(with_keys(
      unknown(of_joints("joint_product", "a joint errs with two others together; @a=4,b=6",
                        make_joint_product)),
      {"a", "b"}));
  all.push_back(with_keys(
      unknown(of_joints("other_joint", "a joint errs with another's angle; @from=1,cycles=2",
                        make_other_joint)),
      {"from", "cycles"}));
  all.push_back(unknown(of_joints(
      "joint_memory", "a joint remembers where it stood one pose before", make_joint_memory)));
  all.push_back(
      needing(unknown(of_joints("warm_encoder", "a joint's zero moves as its drive warms up",
                                make_warm_encoder)),
              Needs::kTemperature));
  all.push_back(
      with_keys(unknown(of_arm("room_sway", "the base breathes in periods; @period_s=3600",
                               Size::kLength, Domain::kMeasurement, make_room_sway)),
                {"period_s"}));
  all.push_back(
      with_keys(unknown(of_arm("tool_wander", "the reflector moves in periods; @period_s=3600",
                               Size::kLength, Domain::kMeasurement, make_tool_wander)),
                {"period_s"}));
}

/// For the study of formulas; the first part of the blind study does not draw them either.
void add_outside_laws(std::vector<LawEntry>& all) {
  const auto outside = [&](const char* name, const char* line, LawMaker make, Needs needs) {
    all.push_back(
        needing(called(with_keys(of_joints(name, line, make), {"from"}), "unknown"), needs));
  };
  outside("folded_sine", "a joint errs with |sin| of another's angle; @from=1", make_folded_sine,
          Needs::kNothing);
  outside("growing", "a joint's error grows towards an end of another's range; @from=1",
          make_growing, Needs::kNothing);
  outside("directed_sine", "twice a turn of another joint, from one side only; @from=1",
          make_directed_sine, Needs::kDirection);
}

/// Causes that look like others, for the study of them.
void add_imitating_laws(std::vector<LawEntry>& all) {
  all.push_back(called(
      of_joints("encoder_counts", "one wrong number of counts a turn at all joints; size: a radian",
                make_encoder_counts),
      "encoder_scale"));
  all.push_back(called(
      of_arm("axial_play", "J1 lifts and sinks on its axis as the arm leans; size: half the play",
             Size::kLength, Domain::kRobot, make_axial_play),
      "unknown"));
  all.push_back(
      like(called(of_arm("moving_air", "moving air bends the tracker's beam; size: at 4 m",
                         Size::kLength, Domain::kMeasurement, make_moving_air),
                  "unknown"),
           {"drift"}));
  all.push_back(called(
      of_arm("rocking_base", "the base rocks about one edge, to one side; size: largest angle",
             Size::kAngle, Domain::kRobot, make_rocking_base),
      "base_compliance"));
  all.push_back(like(called(of_arm("unsensed_growth",
                                   "as thermal_growth, but no sensor is needed; size: arm, 10 K",
                                   Size::kLength, Domain::kEnvironment, make_unsensed_growth),
                            "unknown"),
                     {"thermal_growth"}));
  all.push_back(
      with_keys(called(of_joints("parallelogram_wave",
                                 "a motor's wave by q of the joint before and its own; @cycles=2",
                                 make_parallelogram_wave),
                       "unknown"),
                {"cycles"}));
  LawEntry sun = of_joints("sunny_link", "the sun bends a link to one side; size: shift behind it",
                           make_sunny_link);
  sun.size = Size::kLength;
  all.push_back(called(during(std::move(sun), Domain::kEnvironment), "unknown"));
}

void add_planar_laws(std::vector<LawEntry>& all) {
  all.push_back(called(
      of_arm("planar_published", "beams of the planar study, as its printed figures need them",
             Size::kNone, Domain::kRobot, make_planar_published),
      "unknown"));
  all.push_back(called(
      of_arm("planar_printed", "beams of the planar study, printed dimensions and correct statics",
             Size::kNone, Domain::kRobot, make_planar_printed),
      "link_flexure"));
}

}  // namespace

const std::vector<LawEntry>& law_entries() {
  static const std::vector<LawEntry> entries = [] {
    std::vector<LawEntry> all;
    add_gravity_laws(all);
    add_joint_laws(all);
    add_history_laws(all);
    add_unknown_laws(all);
    add_planar_laws(all);
    add_inconvenient_laws(all);
    add_outside_laws(all);
    add_imitating_laws(all);
    return all;
  }();
  return entries;
}

const LawEntry* find_law(const std::string& name) {
  const auto& entries = law_entries();
  const auto found = std::find_if(entries.begin(), entries.end(),
                                  [&](const LawEntry& entry) { return entry.name == name; });
  return found == entries.end() ? nullptr : &*found;
}

}  // namespace plumb::offline::sim
