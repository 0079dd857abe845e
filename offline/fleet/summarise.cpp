// SPDX-License-Identifier: Apache-2.0
#include "fleet/summarise.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "answers/answers.hpp"
#include "arm/effect_binding.hpp"
#include "cell/fleet_priors.hpp"
#include "cell/setups.hpp"
#include "diagnose/diagnosis.hpp"
#include "effects/registry.hpp"
#include "fit/calibrate.hpp"
#include "fit/cell_data.hpp"
#include "fit/fit.hpp"
#include "fit/fit_cell.hpp"
#include "fit/verdict.hpp"
#include "plumb/format/version.hpp"
#include "program/bounded_file.hpp"
#include "program/file.hpp"
#include "program/problem.hpp"

namespace plumb::offline::fleet {
namespace {

namespace fs = std::filesystem;

std::string sum_of(const fs::path& file, std::uintmax_t most = kMostFileBytes) {
  try {
    return sha256(read_regular_file(file, most));
  } catch (const std::exception&) {
    return "";
  }
}

/// Times the usual prior: as good as none, and the numbers stay finite.
constexpr double kWide = 20.0;

/// The cell without what it takes for known of its arm: what is learnt from an arm must not be what
/// was assumed of it.
Cell with_hardly_any_prior(Cell cell) {
  cell.fit.priors.clear();
  cell.fit.prior_m *= kWide;
  cell.fit.prior_rad *= kWide;
  return cell;
}

EffectDomain domain_of_parameter(const Calibration& c, const Parameter& p) {
  if (!p.of_effect()) return EffectDomain::kRobot;
  return domain_of(c.state.arm.effects[static_cast<std::size_t>(p.joint)]);
}

void put_numbers(const Calibration& c, CellSummary& out) {
  std::vector<Eigen::Index> of_arm;
  for (std::size_t i = 0; i < c.estimates.size(); ++i) {
    const Estimate& e = c.estimates[i];
    const Parameter& p = c.parameters[i];
    if (!e.of_robot || domain_of_parameter(c, p) != EffectDomain::kRobot) continue;
    of_arm.push_back(static_cast<Eigen::Index>(i));
    ArmNumber number{
        .name = e.name, .effect = geometry_effect(), .unit = e.is_length ? "m" : "rad"};
    if (p.of_effect()) {
      number.effect = c.state.arm.effects[static_cast<std::size_t>(p.joint)].name;
      number.unit = e.unit;
    }
    number.value = e.value - e.nominal;
    number.std = e.std;
    out.numbers.push_back(std::move(number));
  }
  out.covariance = c.covariance(of_arm, of_arm);
}

void check_finite(const CellSummary& summary) {
  bool finite = summary.covariance.allFinite() && std::isfinite(summary.held.max);
  for (const auto& n : summary.numbers) finite = finite && std::isfinite(n.value);
  if (finite) return;
  throw Failure(Exit::kNumbersSayNo, {.code = "E-FLEET-CELL",
                                      .message = "its fit gave numbers that are not finite",
                                      .help = "see it by itself: plumb -C CELL fit"});
}

/// The best candidate of every effect of the arm, by the effect's name. What happens while
/// measuring says nothing about sisters.
std::vector<EffectEvidence> evidence_of(const Diagnosis& found) {
  std::map<std::string, double> best;
  for (const auto& candidate : found.candidates) {
    if (candidate.domain != "robot") continue;
    const auto [at, is_new] = best.emplace(candidate.entry.name, candidate.ln_bayes);
    if (!is_new) at->second = std::max(at->second, candidate.ln_bayes);
  }
  std::vector<EffectEvidence> out;
  for (const auto& [effect, ln_bayes] : best) out.push_back({effect, ln_bayes});
  return out;
}

/// Of the cell without what other arms taught, so that no arm is heard twice.
Diagnosis diagnosis_alone(Cell cell, const MeasurementFiles& measured) {
  std::erase_if(cell.fit.priors, [](const Prior& prior) { return prior.of_fleet; });
  cell.fit.sister_odds.clear();
  return diagnose(cell, measured, {});
}

CellDiagnosis summary_of(const Cell& cell, const Diagnosis& found) {
  CellDiagnosis out;
  out.finding = name_of(found.finding);
  out.words = found.text;
  out.evidence = evidence_of(found);
  if (found.finding != Finding::kMissing || found.candidates.empty()) return out;
  out.effect = found.candidates.front().entry.name;
  for (const int joint : found.candidates.front().entry.joints)
    out.joints.push_back(cell.nominal.joints[static_cast<std::size_t>(joint)].name);
  return out;
}

/// A pipe would be waited for, and with it the whole fleet.
void check_regular(const fs::path& file) {
  std::error_code error;
  const auto status = fs::status(file, error);
  if (error || fs::is_regular_file(status) || !fs::exists(status)) return;
  throw Failure(Exit::kInput, {.code = "E-READ",
                               .message = display_name(file) + " is no regular file",
                               .help = "cells of a fleet are read from files"});
}

/// Without the way to the cell, so that the same cell gives the same words wherever it stands.
std::string seen_from(const fs::path& folder, std::string words) {
  for (const std::string& way : {fs::absolute(folder).lexically_normal().string() + "/",
                                 folder.string() + "/", display_name(folder) + "/"})
    for (std::size_t at = 0; (at = words.find(way, at)) != std::string::npos;)
      words.erase(at, way.size());
  return words;
}

void fit_into(const fs::path& folder, Asked asked, CellSummary& out) {
  check_regular(folder / "cell.toml");
  Cell cell = read_cell(folder / "cell.toml");
  for (const auto& file : measurement_files(cell.measurement)) check_regular(file);
  out.arm = cell.name;
  out.robot = cell.robot_name;
  out.serial = cell.serial;
  out.model = model_key(cell.nominal);
  out.tolerance_m = cell.tolerance_m;
  for (const auto& effect : cell.effects) out.effects.push_back(effect.name);
  const MeasurementFiles measured = read_cell_measurements(cell);
  const Fit fit = fit_cell(cell, measured);
  out.held = usual_held(fit);
  out.floor_m = fit.floor.mean_m;
  out.good = fit.held.n > 0 && keeps(usual_held(fit), cell.tolerance_m) && !fit.size_unknown;
  out.verdict_head = verdict_head(fit, cell.tolerance_m);
  out.verdict_class = name_of(grade(fit, cell.tolerance_m));
  put_numbers(
      calibrate_from(with_hardly_any_prior(with_orientations_as_judged(cell, fit.orientations)),
                     measured, fit_rows(fit.split), fit.calibration.state),
      out);
  check_finite(out);
  std::optional<Diagnosis> found;
  if (asked == Asked::kDiagnosis) {
    found = diagnosis_alone(cell, measured);
    out.diagnosis = summary_of(cell, *found);
  }
  out.answers = answers_of(cell, measured, fit, found ? &*found : nullptr);
  out.ok = true;
}

}  // namespace

std::vector<SummaryInput> inputs_of(const fs::path& folder) {
  std::vector<SummaryInput> out{{"plumb", format::kVersion, false},
                                {"cell.toml", sum_of(folder / "cell.toml", kMostCellBytes), false}};
  try {
    check_regular(folder / "cell.toml");
    const Cell cell = read_cell(folder / "cell.toml");
    for (const auto& file : measurement_files(cell.measurement))
      out.push_back(
          {file.lexically_proximate(cell.directory).generic_string(), sum_of(file), true});
    if (!cell.fit.prior_from.empty())
      out.push_back({"priors", sha256(fleet_priors_text(cell.fit)), false});
  } catch (const std::exception&) {
    // Its summary will say why.
  }
  return out;
}

CellSummary summarise(const fs::path& folder, Asked asked) {
  CellSummary out;
  out.name = folder.filename().string();
  out.inputs = inputs_of(folder);
  try {
    fit_into(folder, asked, out);
  } catch (const Failure& failure) {
    out.numbers.clear();
    out.covariance.resize(0, 0);
    out.error_code = failure.problems().front().code;
    out.error = seen_from(folder, failure.problems().front().message);
  } catch (const fs::filesystem_error& failure) {
    out.error_code = "E-READ";
    out.error = failure.code().message();
  }
  return out;
}

}  // namespace plumb::offline::fleet
