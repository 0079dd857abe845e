// SPDX-License-Identifier: Apache-2.0
// Many small waves of all joints, none of which shows alone, are found together as one series.
#include "diagnose/series_of_all.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "diagnose/diagnosis.hpp"
#include "diagnose/effect_words.hpp"
#include "tests/diagnose/hiding.hpp"
#include "tests/diagnose/true_error.hpp"

namespace plumb::offline {
namespace {

/// A dozen waves at each of six joints, whose amplitudes fall with their order. At 1.5 µrad the
/// largest one moves the point by about a fifth of the noise.
std::vector<std::string> many_small_waves(double largest_urad) {
  std::vector<std::string> out;
  for (int joint = 1; joint <= 6; ++joint)
    for (int wave = 0; wave < 12; ++wave)
      out.push_back(fmt::format("gear_ripple:J{}={:.4f}urad@cycles={}", joint,
                                largest_urad / std::sqrt(1.0 + wave),
                                1 + wave * 3 + (joint * 5 + wave * 7) % 3));
  return out;
}

BlindRequest measured_well(std::vector<std::string> effects, int poses, std::uint64_t seed = 1) {
  BlindRequest out = hiding(effects, poses, seed);
  out.sigma_m = 10e-6;
  out.fresh_poses = 300;
  return out;
}

Diagnosis diagnosed(const BlindCase& blind) {
  Diagnosis out = diagnose(blind.cell, blind.measured.measured, {.apply = true, .tell = {}});
  std::printf("%s\n  %s\n", out.text.c_str(), out.text_after.c_str());
  return out;
}

const Addition* series_of_several(const Diagnosis& d) {
  const auto at = std::find_if(d.added.begin(), d.added.end(), [](const Addition& a) {
    return a.entry.name == "joint_series" && a.entry.joints.size() > 1;
  });
  return at == d.added.end() ? nullptr : &*at;
}

/// What the selection had before the series: it is asked for last.
std::vector<EffectEntry> without_series(std::vector<EffectEntry> effects) {
  std::erase_if(effects, [](const EffectEntry& e) {
    return e.name == "joint_series" && e.joints.size() > 1;
  });
  return effects;
}

// The limits are signs alone, which no figure seen has set: whatever the series costs in variance,
// with it the arm must be nearer to the truth, and to poses that it has not seen, than the same
// diagnosis is without it. Noise may lift one of the waves above the others, which is then found
// alone, so that the series is expected of most arms.
TEST(SeriesOfAll, ManySmallWavesThatDoNotShowAloneAreFoundTogether) {
  int found = 0, arms = 0;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    ++arms;
    const BlindCase blind = make_blind_case(measured_well(many_small_waves(1.5), 500, seed));
    const Diagnosis d = diagnosed(blind);
    const Addition* series = series_of_several(d);
    if (series == nullptr) continue;
    ++found;
    EXPECT_EQ(d.finding, Finding::kMissing) << d.text;
    const double with = true_error_of(blind, d.effects);
    const double without = true_error_of(blind, without_series(d.effects));
    std::printf("seed %d: true error %.2f -> %.2f um\n", static_cast<int>(seed), 1e6 * without,
                1e6 * with);
    EXPECT_LT(with, without) << "seed " << seed;
    EXPECT_LT(d.after.mean, d.before.mean) << "seed " << seed;
    const std::string words = in_words(blind.cell, *series);
    EXPECT_TRUE(says(words, "gear errors of several joints, ")) << words;
    EXPECT_TRUE(says(words, " µrad RMS at J")) << words;
  }
  EXPECT_GT(2 * found, arms);
}

// Waves of this size would be found: only what these poses cannot show forbids the question.
TEST(SeriesOfAll, ItIsNotAskedWhereThePosesCannotShowIt) {
  const Diagnosis d = diagnosed(make_blind_case(measured_well(many_small_waves(30.0), 80)));
  EXPECT_EQ(series_of_several(d), nullptr) << d.text_after;
}

TEST(SeriesOfAll, NothingOrOneEffectIsNoSeriesOfSeveralJoints) {
  for (const auto& effects :
       {std::vector<std::string>{}, std::vector<std::string>{"joint_compliance:J2:5"},
        std::vector<std::string>{"gear_ripple:J2:5@cycles=17"},
        std::vector<std::string>{"backlash_load:J2:4"}}) {
    const Diagnosis d = diagnosed(make_blind_case(measured_well(effects, 500)));
    EXPECT_EQ(series_of_several(d), nullptr) << d.text_after;
  }
}

}  // namespace
}  // namespace plumb::offline
