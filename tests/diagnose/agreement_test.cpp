// SPDX-License-Identifier: Apache-2.0
// fit, compare and diagnose say the same of what a model leaves: noise, few poses, or a lack of
// fit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "compare/lack_of_fit.hpp"
#include "diagnose/diagnosis_text.hpp"
#include "fit/few_poses.hpp"
#include "fit/verdict.hpp"
#include "numbers/tails.hpp"
#include "show/compare_words.hpp"
#include "tests/random_numbers.hpp"

namespace plumb::offline {
namespace {

constexpr std::uint64_t kSeed = 173;
constexpr double kTolerance_m = 100e-6;

/// A fit with any floor, any number of coordinates and parameters, and any error on held-out poses.
Fit any_fit(tests::Random& random) {
  Fit out;
  const double floor_m = std::pow(10.0, random.uniform(-5.5, -3.5));
  const double held_m = floor_m * std::pow(10.0, random.uniform(-0.3, 0.7));
  const double tail = random.uniform(1.5, 2.5);
  out.held = {.n = 50, .mean = held_m, .rms = held_m, .p95 = tail * held_m, .max = 2.0 * held_m};
  out.held.max = std::max(out.held.max, out.held.p95);
  out.held_without_outliers = out.held;
  out.floor = {.sigma_m = floor_m / 1.596,
               .mean_m = floor_m,
               .rms_m = floor_m,
               .dof = 60,
               .source = random.uniform(0.0, 1.0) < 0.5 ? NoiseFloor::Source::kRepeats
                                                        : NoiseFloor::Source::kSigma};
  if (random.uniform(0.0, 1.0) < 0.3) out.floor.inferred_m = floor_m * random.uniform(1.1, 4.0);
  const double parameters = std::floor(random.uniform(10.0, 60.0));
  out.unavoidable_ratio =
      unavoidable_ratio(parameters + std::pow(10.0, random.uniform(0.0, 4.0)), parameters);
  return out;
}

/// Any outcome of the test on the fitted readings, also one that chance made differ.
compare::LackOfFit any_test(tests::Random& random) {
  compare::LackOfFit out;
  out.basis = compare::LackOfFit::Basis::kRepeats;
  out.dof_model = static_cast<int>(random.uniform(3.0, 1500.0));
  out.dof_noise = static_cast<int>(random.uniform(5.0, 500.0));
  out.ratio = std::pow(10.0, random.uniform(-0.2, 1.0));
  out.ln_p = ln_f_tail(out.ratio, out.dof_model, out.dof_noise);
  out.systematic = std::max(0.0, 1.0 - 1.0 / out.ratio);
  return out;
}

Diagnosis complete(const Fit& fit) {
  Diagnosis out;
  out.floor = fit.floor;
  out.before = out.after = fit.held;
  out.held_out_excess = held_out_excess(fit.held.mean, fit.floor, fit.unavoidable_ratio);
  return out;
}

bool says(const std::string& text, const char* words) {
  return text.find(words) != std::string::npos;
}

TEST(Agreement, TheThreeVerbsNeverContradictEachOther) {
  const long count = tests::scaled(20'000);
  std::printf("%ld fits, seed %llu\n", count, static_cast<unsigned long long>(kSeed));
  tests::Random random(kSeed);
  const Cell cell;
  long at_floor = 0, few = 0, lack = 0;
  for (long i = 0; i < count; ++i) {
    const Fit fit = any_fit(random);
    const std::string fitted = verdict(fit, kTolerance_m);
    const std::string diagnosed = verdict_text(cell, complete(fit));
    const std::string compared = show::lack_of_fit_words(any_test(random), fit);
    const std::string all = fitted + "\n" + compared + "\n" + diagnosed;
    const bool missing = says(diagnosed, "something that these poses do not name");
    ASSERT_FALSE(says(fitted, "physical") && !missing) << all;
    ASSERT_FALSE(says(fitted, "nothing more can be learnt") && missing) << all;
    ASSERT_FALSE(says(fitted, "at the noise floor") && missing) << all;
    ASSERT_FALSE(says(fitted, "as few poses leave it") && missing) << all;
    ASSERT_FALSE(says(fitted, "at the noise floor") && says(compared, "a better model")) << all;
    ASSERT_FALSE(missing && says(compared, "no more than the noise of the readings")) << all;
    ASSERT_FALSE(says(fitted, "physical") && says(compared, "above the noise floor")) << all;
    ASSERT_FALSE(says(fitted, "inferred from") && says(compared, "a better model")) << all;
    at_floor += says(fitted, "at the noise floor") ? 1 : 0;
    few += says(fitted, "as few poses leave it") ? 1 : 0;
    lack += says(fitted, "physical") ? 1 : 0;
  }
  EXPECT_GT(std::min({at_floor, few, lack}), count / 50) << "each kind must occur";
}

TEST(Agreement, ALevelNeverFallsAsTheErrorGrowsAndNeverRisesWithFewerPoses) {
  for (const double unavoidable : {1.0, 1.1, 1.149, 1.151, 1.5, 3.0})
    for (double times = 0.0; times < 6.0; times += 0.01) {
      const HeldOutExcess here{times, unavoidable};
      EXPECT_LE(here.level(), (HeldOutExcess{times + 0.01, unavoidable}.level()));
      EXPECT_GE(here.level(), (HeldOutExcess{times, unavoidable + 0.5}.level()));
    }
}

}  // namespace
}  // namespace plumb::offline
