// SPDX-License-Identifier: Apache-2.0
#include "fit/fit_judgement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "arm/effect_binding.hpp"
#include "fit/common_scale.hpp"
#include "fit/constants.hpp"

namespace plumb::offline {
namespace {

bool beyond(const Estimate& e, double limit_m, double limit_rad) {
  return e.of_robot && e.unit.empty() &&
         std::abs(e.value - e.nominal) > (e.is_length ? limit_m : limit_rad);
}

std::string how_far(const Estimate& e) {
  const double change = e.value - e.nominal;
  return fmt::format("{} ended {:.2f} {} from nominal", e.name,
                     e.is_length ? change * 1e3 : change * 180.0 / M_PI,
                     e.is_length ? "mm" : "deg");
}

}  // namespace

void check_same_arm(const std::vector<Estimate>& estimates) {
  for (const auto& e : estimates)
    if (beyond(e, kAnotherArm_m, kAnotherArm_rad))
      throw Failure(Exit::kNumbersSayNo,
                    {.code = "E-FIT-FAR",
                     .message = how_far(e) + ": cell.toml does not describe the arm as these "
                                             "readings were taken",
                     .help = "find the wrong joint zero, unit, joint sign or DH convention: plumb "
                             "check"});
}

bool ends_far(const std::vector<Estimate>& estimates) {
  return std::any_of(estimates.begin(), estimates.end(),
                     [](const Estimate& e) { return beyond(e, kFar_m, kFar_rad); });
}

void warn_of_far_parameters(const Cell& cell, const Calibration& calibration,
                            std::vector<Problem>& remarks) {
  const double prior_m = cell.fit.prior_m > 0.0 ? cell.fit.prior_m : kUnsetPrior;
  auto scale = common_scale(calibration, prior_m);
  if (scale && !scale->unusual()) scale.reset();
  if (scale) remarks.push_back(scale_remark(*scale));
  const auto explained = [&](const Estimate& e) {
    return scale && e.is_length && std::abs(e.value - e.nominal - scale->change_m(e)) < kFar_m;
  };
  for (const auto& e : calibration.estimates)
    if (beyond(e, kFar_m, kFar_rad) && !explained(e))
      remarks.push_back(
          {.severity = Severity::kWarning,
           .code = "W-FIT-FAR",
           .message = how_far(e),
           .help = "compare the nominal value with the data sheet; to hold it: [fit] fixed = [\"" +
                   e.name + "\"]"});
}

bool possible(double value, double std, const EffectParameter& info) {
  const double margin = kSureBeyond_sigma * std;
  return info.low == info.high || (value >= info.low - margin && value <= info.high + margin);
}

void warn_of_impossible_effects(const Calibration& calibration, std::vector<Problem>& remarks) {
  const format::Model& arm = calibration.state.arm;
  for (std::size_t i = 0; i < calibration.parameters.size(); ++i) {
    const Parameter& p = calibration.parameters[i];
    if (!p.of_effect()) continue;
    const Estimate& e = calibration.estimates[i];
    const EffectParameter info = effect_parameter(arm, p.joint, p.component);
    if (possible(e.value, e.std, info)) continue;
    remarks.push_back(
        {.severity = Severity::kWarning,
         .code = "W-FIT-IMPOSSIBLE",
         .message = fmt::format("{} is {:.3g} {} (1 sigma {:.1g}), but its law goes from {:g} to "
                                "{:g}: it imitates something else",
                                e.name, e.value, e.unit, e.std, info.low, info.high),
         .help = "find what it is: plumb diagnose"});
  }
}

}  // namespace plumb::offline
