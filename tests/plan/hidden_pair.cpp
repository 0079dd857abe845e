// SPDX-License-Identifier: Apache-2.0
#include "tests/plan/hidden_pair.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "cell/measurement_reader.hpp"
#include "diagnose/diagnosis.hpp"
#include "diagnose/scan.hpp"
#include "simulate/law.hpp"
#include "tests/cases/blind_case.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::offline {
namespace {

constexpr double kUndecided_nats = 10.0;

const std::vector<std::string>& hidden_choices() {
  static const std::vector<std::string> all = {"joint_compliance:J2",
                                               "joint_compliance:J3",
                                               "joint_compliance:J5",
                                               "link_flexure:J2",
                                               "link_flexure:J3",
                                               "gravity_compensator:J2",
                                               "gear_harmonics:J2",
                                               "gear_harmonics:J3",
                                               "gear_harmonics:J4",
                                               "base_compliance:",
                                               "tool_sag:",
                                               "backlash_load:J2",
                                               "backlash_load:J3",
                                               "joint_compliance_soft:J3",
                                               "cross_compliance:J3",
                                               "encoder_scale:J2",
                                               "encoder_scale:J3",
                                               "axis_wobble:J1",
                                               "axis_wobble:J2",
                                               "wrist_coupling:",
                                               "reversal:J2",
                                               "reversal:J3",
                                               "settling_lag:J2",
                                               "settling_lag:J1",
                                               "thermal_growth:",
                                               "drift:",
                                               "encoder_eccentricity:J3",
                                               "gear_ripple:J2",
                                               "payload_compliance:J2",
                                               "tracker:",
                                               "gear_harmonics:J6"};
  return all;
}

/// Whether a candidate names the hidden effect: the law, or one that describes the same motion, at
/// a joint where it is hidden.
bool is_right(const EffectEntry& entry, const HiddenEffect& hidden) {
  const sim::LawEntry& law = *sim::find_law(hidden.name);
  const bool named = entry.name == law.library || std::find(law.same_as.begin(), law.same_as.end(),
                                                            entry.name) != law.same_as.end();
  if (!named || law.on == sim::LawEntry::On::kArm || entry.joints.empty()) return named;
  return std::any_of(hidden.joints.begin(), hidden.joints.end(),
                     [&](const auto& part) { return entry.joints.front() == part.joint; });
}

/// What hides in the arm of a number, and how it is measured first: 45 to 150 poses.
SimulationPlan recipe_of(const Cell& cell, std::uint64_t number, tests::Random& random) {
  SimulationPlan out;
  const auto pick = [&](auto... values) {
    const std::array all{values...};
    return all[static_cast<std::size_t>(random.uniform(0.0, 1.0) * 0.999 * all.size())];
  };
  const auto& hidden = hidden_choices();
  const auto& name = hidden[number % hidden.size()];
  out.seed = number;
  out.truth.seed = number;
  out.poses = pick(45, 60, 80, 110, 150);
  out.repeats = 3;
  out.noise_m = pick(10e-6, 20e-6);
  out.choice.range = pick(0.4, 0.6, 0.8, 1.0);
  out.directions = out.temperatures = Recorded::kAlways;
  out.session_s = 3.0 * 3600.0;
  out.seconds_per_pose = *out.session_s / (1.2 * out.poses);
  out.truth.geometry_m = out.truth.geometry_rad = 0.4e-3;
  out.truth.mass_share = 0.15;
  const double size = pick(1.0, 2.0, 5.0, 10.0);
  out.truth.effects = {name + ":" + std::to_string(size)};
  if (pick(0, 1) == 1)
    for (const double share : {0.15, 0.55, 1.0}) {
      out.payloads.push_back(cell.payload);
      out.payloads.back().mass_kg *= share;
    }
  return out;
}

Cell arm_of(BlindArm arm) {
  BlindRequest request;
  request.arm = arm;
  request.poses = request.fresh_poses = 40;
  return make_blind_case(request).cell;
}

}  // namespace

MeasurementFiles read_files(const Cell& cell, const std::vector<std::string>& texts) {
  static int number = 0;
  const auto folder =
      std::filesystem::temp_directory_path() /
      ("plumb-pairs-" + std::to_string(::getpid()) + "-" + std::to_string(++number));
  std::filesystem::create_directories(folder);
  std::vector<std::filesystem::path> paths;
  for (const auto& text : texts) {
    paths.push_back(folder / (std::to_string(paths.size()) + ".csv"));
    std::ofstream(paths.back()) << text;
  }
  MeasurementFiles out =
      read_measurements(paths, std::vector<bool>(static_cast<std::size_t>(cell.joints()), true),
                        Needs::kJointsAndPosition);
  std::filesystem::remove_all(folder);
  return out;
}

std::optional<HiddenPair> hidden_pair(std::uint64_t number) {
  tests::Random random(number * 7919 + 17);
  const bool is_heavy = random.uniform(0.0, 1.0) < 0.5;
  HiddenPair out;
  out.cell = arm_of(is_heavy ? BlindArm::kHeavy : BlindArm::kLight);
  out.carries_kg = is_heavy ? 60.0 : 10.0;
  out.recipe = recipe_of(out.cell, number, random);
  out.cell.measurement.sigma_m = out.recipe.noise_m;
  try {
    out.first = simulate(out.cell, out.recipe);
    out.first_csv = simulated_csv(out.cell, out.first);
    const Diagnosis found = diagnose(out.cell, read_files(out.cell, {out.first_csv}), {});
    const auto& all = found.candidates;
    if (all.empty() || !all.front().supported) return std::nullopt;
    const HiddenEffect& hidden = out.first.effects.front();
    const auto right = std::find_if(all.begin(), all.end(),
                                    [&](const Candidate& c) { return is_right(c.entry, hidden); });
    if (right == all.end()) return std::nullopt;
    const auto confounded = [&](const Candidate& a, const Candidate& b) {
      const auto& with = a.confounded_with;
      return std::find(with.begin(), with.end(), key_of(out.cell, b.entry)) != with.end();
    };
    for (const auto& other : all) {
      if (is_right(other.entry, hidden) || !confounded(*right, other)) continue;
      if (&other != &all.front() && &*right != &all.front()) continue;
      if (std::abs(right->ln_bayes - other.ln_bayes) >= kUndecided_nats) continue;
      out.truth = right->entry;
      out.rival = other.entry;
      out.lead = right->ln_bayes - other.ln_bayes;
      out.separate = right->separate;
      out.words = key_of(out.cell, out.truth) + " or " + key_of(out.cell, out.rival);
      return out;
    }
  } catch (const Failure&) {
    return std::nullopt;  // an effect that cannot be seen there, or too few poses
  }
  return std::nullopt;
}

std::string measured_csv(const HiddenPair& pair, const std::vector<PlannedReading>& plan) {
  SimulationPlan recipe = pair.recipe;
  recipe.seed += 1000003;
  recipe.repeats = 1;
  recipe.truth.effects.clear();
  recipe.truth.sized = pair.first.effects;
  if (recipe.payloads.empty()) recipe.payloads = {pair.cell.payload};
  std::vector<Eigen::VectorXd> q;
  std::vector<int> rows;
  const double begin_s = *recipe.session_s;
  recipe.stated.clear();
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const auto& reading = plan[i];
    const double later_s = 30.0 * static_cast<double>(i) + (reading.warm ? 5400.0 : 0.0);
    const StatedVisit visit{reading.payload.value_or(pair.cell.payload), begin_s + later_s,
                            later_s};
    if (reading.from) q.push_back(*reading.from), recipe.stated.push_back(visit);
    rows.push_back(static_cast<int>(q.size()));
    q.push_back(reading.q);
    recipe.stated.push_back(visit);
  }
  recipe.q.resize(static_cast<Eigen::Index>(q.size()), pair.cell.joints());
  for (std::size_t i = 0; i < q.size(); ++i)
    recipe.q.row(static_cast<Eigen::Index>(i)) = q[i].transpose();
  recipe.poses = static_cast<int>(q.size());
  const Simulation all = simulate(pair.cell, recipe);
  Measurements measured = pick(static_cast<const Measurements&>(all.measured), rows);
  for (std::size_t i = 0; i < measured.pose.size(); ++i)
    measured.pose[i] = "N" + std::to_string(i + 1);
  std::vector<Column> context = all.context;
  for (auto& column : context) {
    std::vector<double> values;
    for (const int row : rows) values.push_back(column.values[static_cast<std::size_t>(row)]);
    column.values = values;
  }
  return write_measurements(measured,
                            std::vector<bool>(static_cast<std::size_t>(pair.cell.joints()), true),
                            {{"instrument", "simulated laser tracker"}}, context);
}

double lead_with(const HiddenPair& pair, const std::string& second_csv) {
  const Diagnosis found =
      diagnose(pair.cell, read_files(pair.cell, {pair.first_csv, second_csv}), {});
  if (found.candidates.empty()) return 0.0;
  const auto ln_bayes = [&](const EffectEntry& entry) {
    const auto same =
        std::find_if(found.candidates.begin(), found.candidates.end(), [&](const Candidate& c) {
          return c.entry.name == entry.name && c.entry.joints == entry.joints;
        });
    return same == found.candidates.end() ? found.candidates.back().ln_bayes : same->ln_bayes;
  };
  return ln_bayes(pair.truth) - ln_bayes(pair.rival);
}

}  // namespace plumb::offline
