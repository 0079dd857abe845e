// SPDX-License-Identifier: Apache-2.0
#include "check/effect_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plumb::offline {
namespace {

using Answer = Testable::Answer;

constexpr double kLever_m = 0.02;        // gravity torque that varies by that times the weight
constexpr double kWideRange = M_PI / 3;  // 60 deg
constexpr double kWarm_K = 2.0, kWarmer_K = 5.0;
constexpr double kBothWays = 0.2;  // share of the rarer direction
constexpr int kFewPoses = 40, kManyPoses = 150, kDensePoses = 500;

struct Verdict {
  Answer answer = Answer::kYes;
  std::string why;
};

Verdict yes(std::string why) { return {Answer::kYes, std::move(why)}; }
Verdict weakly(std::string why) { return {Answer::kWeakly, std::move(why)}; }
Verdict no(std::string why) { return {Answer::kNo, std::move(why)}; }

/// What a rule looks at.
struct Evidence {
  const Cell& cell;
  const DataSense& data;

  /// Names of the turning joints for which `holds`.
  template <class Holds>
  std::string joints(Holds holds) const {
    std::vector<std::string> out;
    for (int j = 0; j < data.joints(); ++j)
      if (data.turns[j] && holds(j)) out.push_back(cell.nominal.joints[j].name);
    return fmt::format("{}", fmt::join(out, ", "));
  }
  std::string loaded() const {
    return joints([&](int j) { return data.lever_m[j] > kLever_m; });
  }
  std::string unloaded() const {
    return joints([&](int j) { return data.lever_m[j] <= kLever_m; });
  }
  std::string without_turn(double range) const {
    return joints([&](int j) { return data.range[j] < range; });
  }
};

std::string except(const std::string& joints, const char* why) {
  return joints.empty() ? "" : fmt::format("; not at {}: {}", joints, why);
}

Verdict geometry(const Evidence& e) {
  if (e.data.poses < 10) return no(fmt::format("{} poses", e.data.poses));
  if (e.data.poses < kFewPoses) return weakly(fmt::format("{} poses", e.data.poses));
  return yes(fmt::format("{} poses", e.data.poses));
}

Verdict compliance(const Evidence& e) {
  if (e.loaded().empty()) return no("gravity turns no joint differently from pose to pose");
  const std::string why = fmt::format("the load of {} varies with the pose", e.loaded()) +
                          except(e.unloaded(), "gravity never turns it");
  if (e.data.poses < kFewPoses) return weakly(why + fmt::format("; {} poses", e.data.poses));
  return e.data.has_masses || e.data.payload_span_kg > 0.0
             ? yes(why)
             : weakly(why + "; masses unknown, so only as free combinations");
}

Verdict soft_compliance(const Evidence& e) {
  const Verdict linear = compliance(e);
  if (linear.answer == Answer::kNo || e.data.payload_span_kg > 0.0) return linear;
  return weakly("at one payload a soft start looks like plain compliance");
}

Verdict gravity_free(const Evidence& e) {
  if (e.loaded().empty()) return no("gravity turns no joint differently from pose to pose");
  return e.data.poses < kManyPoses
             ? weakly(fmt::format("{} poses for several numbers a joint", e.data.poses))
             : yes(fmt::format("the load of {} varies with the pose", e.loaded()));
}

Verdict flexure(const Evidence& e) {
  if (e.loaded().empty()) return no("the load of no link varies");
  if (e.data.payload_span_kg > 0.0) return yes("the payload varies");
  return weakly("at one payload bending links look much like compliant joints");
}

Verdict harmonics(const Evidence& e) {
  const std::string narrow = e.without_turn(M_PI);
  if (e.data.poses < kFewPoses) return no(fmt::format("{} poses", e.data.poses));
  const std::string wide = e.joints([&](int j) { return e.data.range[j] >= M_PI; });
  if (wide.empty()) return no("no joint moves over half a turn");
  const std::string why =
      fmt::format("{} move over half a turn or more", wide) + except(narrow, "too small a range");
  return narrow.empty() ? yes(why) : weakly(why);
}

Verdict ripple(const Evidence& e) {
  if (e.data.poses < kFewPoses) return no(fmt::format("{} poses", e.data.poses));
  if (e.data.poses < kManyPoses)
    return weakly(fmt::format("{} poses for a scan over many frequencies", e.data.poses));
  const std::string known = e.joints([&](int j) { return e.data.has_gear_ratio[j]; });
  return yes(known.empty() ? "enough poses for a scan" : "gear ratio known for " + known);
}

Verdict table(const Evidence& e) {
  if (e.data.poses < kManyPoses)
    return no(fmt::format("{} poses for about 100 numbers a joint", e.data.poses));
  return e.data.poses < kDensePoses ? weakly(fmt::format("{} poses", e.data.poses))
                                    : yes(fmt::format("{} poses", e.data.poses));
}

Verdict scale(const Evidence& e) {
  const std::string narrow = e.without_turn(kWideRange);
  if (e.without_turn(1e-2) == e.joints([](int) { return true; })) return no("no joint moves");
  if (narrow.empty()) return yes("every joint moves by more than 60 deg");
  return weakly("small range" + except(narrow, "it moves by less than 60 deg"));
}

Verdict eccentricity(const Evidence& e) {
  const Verdict v = harmonics(e);
  return v.answer == Answer::kNo ? v : weakly("the same as the first harmonic: one of the two");
}

Verdict reversal(const Evidence& e) {
  if (e.joints([&](int j) { return e.data.both_ways[j] >= 0.0; }).empty())
    return no(e.data.ordered ? "no dir_jN columns"
                             : "nothing says from which side the joints arrived");
  const std::string both = e.joints([&](int j) { return e.data.both_ways[j] >= kBothWays; });
  const std::string one = e.joints([&](int j) { return e.data.both_ways[j] < kBothWays; });
  if (both.empty()) return no("every joint arrives from one side only");
  const std::string why =
      fmt::format("{} arrive from both sides", both) + except(one, "from one side only");
  const std::string travel = e.joints([&](int j) { return e.data.has_travel[j]; });
  return travel.empty() ? weakly(why + "; no travel_jN columns") : yes(why);
}

Verdict backlash(const Evidence& e) {
  if (e.loaded().empty()) return no("no joint carries a load that varies");
  return e.data.has_masses
             ? yes("loads change with the pose")
             : weakly("masses unknown, so it is not known where the load changes side");
}

Verdict lag(const Evidence& e) {
  if (!e.data.ordered) return no("the order of the rows is not known");
  return e.data.poses < kFewPoses ? weakly(fmt::format("{} poses", e.data.poses))
                                  : yes("rows in order");
}

Verdict wobble(const Evidence& e) {
  const Verdict v = harmonics(e);
  if (v.answer == Answer::kNo) return v;
  return e.data.poses < kManyPoses ? weakly(fmt::format("{} poses", e.data.poses)) : v;
}

Verdict wrist(const Evidence& e) {
  if (e.data.joints() < 6) return no("the arm has no three-joint wrist");
  for (int j = 3; j < 6; ++j)
    if (e.data.range[j] < kWideRange)
      return no(fmt::format("{} moves by less than 60 deg", e.cell.nominal.joints[j].name));
  return yes("all three wrist joints move");
}

Verdict cross_compliance(const Evidence& e) {
  const Verdict v = compliance(e);
  return v.answer == Answer::kYes && !e.data.has_masses ? weakly("masses unknown") : v;
}

Verdict thermal(const Evidence& e) {
  if (e.data.has_temperature) {
    const std::string why =
        fmt::format("{} varies by {:.1f} K", e.data.temperature, e.data.temperature_span_K);
    if (e.data.temperature_span_K >= kWarmer_K) return yes(why);
    if (e.data.temperature_span_K > kWarm_K) return weakly(why);
    return no(why + ", at one temperature growth is geometry");
  }
  if (e.data.hours > 0.5)
    return weakly(fmt::format("no temperature, but {:.1f} h of time", e.data.hours));
  if (e.data.hours > 0.0)
    return no(fmt::format("no temperature is recorded, and {:.0f} min are too short to warm up",
                          60.0 * e.data.hours));
  return no("neither temperature nor time is recorded");
}

Verdict base(const Evidence& e) {
  double lever = 0.0;
  for (const double l : e.data.lever_m) lever = std::max(lever, l);
  if (lever < kLever_m) return no("the moment on the base does not vary");
  return e.data.has_masses || e.data.payload_span_kg > 0.0
             ? yes("the moment on the base varies with the pose")
             : weakly("masses unknown; it looks much like compliance of the first joints");
}

Verdict sag(const Evidence& e) {
  // The tool sags differently only if it is tipped against gravity.
  if (e.data.lever_m.back() < 1e-3 && e.loaded().empty()) return no("the tool is never tipped");
  if (e.data.payload_span_kg > 0.0) return yes("the payload varies");
  return e.data.has_payload ? yes("payload known, the tool is tipped")
                            : weakly("payload unknown, so only its product with the softness");
}

Verdict compensator(const Evidence& e) {
  if (e.data.joints() < 2 || e.data.range[1] < kWideRange)
    return no("the second joint hardly moves");
  return weakly("depends on q2 alone: inseparable from that joint's harmonics");
}

Verdict payload(const Evidence& e) {
  if (e.data.payload_span_kg > 0.0)
    return yes(fmt::format("payload varies by {:.1f} kg", e.data.payload_span_kg));
  return no(e.data.has_payload ? "one payload only" : "no payload column");
}

Verdict wrench(const Evidence& e) {
  return e.data.has_wrench ? yes("forces are recorded") : no("no columns of force or torque");
}

Verdict drift(const Evidence& e) {
  if (!e.data.ordered) return no("neither time nor order is recorded");
  const std::string why = e.data.hours > 0.0 ? fmt::format("{:.1f} h of time", e.data.hours)
                                             : std::string("rows in order");
  return e.data.revisits > 2 ? yes(why + fmt::format(", {} poses again later", e.data.revisits))
                             : weakly(why + ", but no pose is measured again later");
}

Verdict step(const Evidence& e) {
  if (!e.data.ordered) return weakly("the rows are taken to be in the order of measuring");
  return yes("rows in order");
}

Verdict tracker(const Evidence& e) {
  if (!e.data.tracker_frame)
    return weakly("nothing says that the origin of the points is the tracker (# frame: tracker)");
  return e.data.poses < kManyPoses ? weakly(fmt::format("{} poses", e.data.poses))
                                   : yes("points in the tracker's own frame");
}

Verdict formula(const Evidence&) { return weakly("depends on the formula"); }

/// One line an effect: its rule, and what to measure if the answer is not yes.
struct Rule {
  const char* effect;
  Verdict (*rule)(const Evidence&);
  const char* measure;
};

constexpr Rule kRules[] = {
    {"geometry", geometry, "at least 50 poses all over the joint limits"},
    {"joint_compliance", compliance,
     "poses with the arm stretched and folded; the same poses with and without payload"},
    {"joint_compliance_soft", soft_compliance, "the same poses with two payloads (payload_kg)"},
    {"gravity_free", gravity_free, "150 poses in many orientations"},
    {"link_flexure", flexure, "the same poses with and without payload (payload_kg)"},
    {"gear_harmonics", harmonics, "each joint over at least half a turn, 40 poses or more"},
    {"gear_ripple", ripple,
     "150 poses not on a grid, or one joint swept alone in small uneven steps; gear_ratio"},
    {"joint_table", table, "500 poses, or one joint swept alone in steps of 2 deg"},
    {"encoder_scale", scale, "each joint near both of its limits"},
    {"encoder_eccentricity", eccentricity, "each joint over at least half a turn, 40 poses"},
    {"reversal", reversal,
     "each pose from the + and the - side, with dir_jN (import --dir from-order)"},
    {"backlash_load", backlash, "masses in cell.toml; poses on both sides of the balance"},
    {"settling_lag", lag, "rows in the order of measuring with t_s; some poses again after a wait"},
    {"axis_wobble", wobble, "150 poses, each joint over at least half a turn"},
    {"wrist_coupling", wrist, "poses that move each wrist joint by more than 60 deg"},
    {"cross_compliance", cross_compliance, "masses in cell.toml, or two payloads"},
    {"thermal_growth", thermal,
     "the same poses cold and warm, more than 5 K apart, with temp_NAME_degC"},
    {"base_compliance", base, "poses stretched to all sides; masses in cell.toml or two payloads"},
    {"tool_sag", sag, "poses with the tool up, down and sideways; payload_kg"},
    {"gravity_compensator", compensator, "the second joint over its whole range"},
    {"payload_compliance", payload, "the same poses with at least two payloads (payload_kg)"},
    {"wrench_compliance", wrench, "the same poses pulled at with known forces"},
    {"drift", drift, "time (t_s), and the first poses again at the end"},
    {"step", step, "time (t_s) or rows in order; the first poses again at the end"},
    {"tracker", tracker,
     "points in the tracker's own frame (# frame: tracker), at several distances"},
    {"formula", formula, "whatever the formula names"},
};

}  // namespace

std::vector<Testable> testable_effects(const Cell& cell, const DataSense& sense) {
  std::vector<Testable> out;
  const Evidence evidence{cell, sense};
  for (const Rule& rule : kRules) {
    Verdict v = rule.rule(evidence);
    out.push_back(
        {v.answer, rule.effect, std::move(v.why), v.answer == Answer::kYes ? "" : rule.measure});
  }
  return out;
}

}  // namespace plumb::offline
