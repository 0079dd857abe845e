// SPDX-License-Identifier: Apache-2.0
#include "cell/units.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <random>

#include "cell/rotation.hpp"
#include "cell/toml_text.hpp"
#include "support.hpp"

namespace plumb::offline {
namespace {

double parsed(const std::string& text) {
  double value = NAN;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

TEST(Units, WriteBackWhatWasReadDigitByDigit) {
  constexpr int kCount = 20000;
  constexpr unsigned kSeed = 3;
  std::printf("%d numbers, seed %u\n", kCount, kSeed);
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> mantissa(-1.0, 1.0);
  std::uniform_int_distribution<int> exponent(-3, 4), digits(1, 17);
  for (int i = 0; i < kCount; ++i) {
    const std::string& name = unit_names()[static_cast<std::size_t>(i) % unit_names().size()];
    const Unit unit = *unit_of(name);
    const double value = mantissa(random) * std::pow(10.0, exponent(random));
    const std::string written = fmt::format("{:.{}g}", value, digits(random));
    const double si = unit.to_si(parsed(written));
    const std::string text = text_in(unit, si);
    const double slack = text.size() <= 12 ? 2.3e-16 * std::abs(si) : 0.0;
    EXPECT_LE(std::abs(unit.to_si(parsed(text)) - si), slack) << written << " " << name;
    if (unit.offset == 0.0 && written.size() <= 12) {
      EXPECT_EQ(parsed(text), parsed(written)) << name;
    }
  }
}

TEST(Units, AreWithinALastPlaceForAnyNumber) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform(-10.0, 10.0);
  for (int i = 0; i < 10000; ++i) {
    const double si = uniform(random);
    for (const char* name : {"mm", "deg", "um", "in"}) {
      const Unit unit = *unit_of(name);
      EXPECT_NEAR(unit.to_si(parsed(text_in(unit, si))), si, 4e-16 * std::abs(si));
    }
  }
}

TEST(Units, AreWrittenAsAPersonWould) {
  EXPECT_EQ(text_in(*unit_of("mm"), 0.1157), "115.7");
  EXPECT_EQ(text_in(*unit_of("mm"), -0.0), "0");
  EXPECT_EQ(text_in(*unit_of("mm"), 0.1234), "123.4");
  EXPECT_EQ(text_in(*unit_of("deg"), M_PI), "180");
  EXPECT_EQ(text_in(*unit_of("K"), 20.0), "293.15");
}

TEST(Rotation, ComesBackFromItsAnglesEvenAtTheSingularity) {
  constexpr int kCount = 20000;
  constexpr unsigned kSeed = 5;
  std::printf("%d rotations, seed %u\n", kCount, kSeed);
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> angle(-M_PI, M_PI), small(-1e-7, 1e-7);
  for (int i = 0; i < kCount; ++i) {
    std::array<double, 3> rpy{angle(random), angle(random), angle(random)};
    if (i % 2) rpy[1] = (i % 4 == 1 ? M_PI_2 : -M_PI_2) + (i % 3 ? small(random) : 0.0);
    const auto q = quaternion_from_rpy(rpy);
    const auto back = quaternion_from_rpy(rpy_from_quaternion(q));
    double dot = 0.0;
    for (int k = 0; k < 4; ++k) dot += q[k] * back[k];
    double error = 0.0;
    for (int k = 0; k < 4; ++k)
      error = std::max(error, std::abs(q[k] - std::copysign(1.0, dot) * back[k]));
    EXPECT_LT(error, 1e-15);
  }
}

TEST(Rotation, IsWrittenAsAPersonWould) {
  const Unit mm = *unit_of("mm"), deg = *unit_of("deg");
  const auto text = [&](double r, double p, double y) {
    const double d = M_PI / 180.0;
    return toml_pose({{0, 0, 0.15}, quaternion_from_rpy({r * d, p * d, y * d})}, mm, deg);
  };
  EXPECT_EQ(text(0, 0, 0), "{ xyz = [0, 0, 150], rpy = [0, 0, 0] }");
  EXPECT_EQ(text(90, 0, 0), "{ xyz = [0, 0, 150], rpy = [90, 0, 0] }");
  EXPECT_EQ(text(0, 0, -45), "{ xyz = [0, 0, 150], rpy = [0, 0, -45] }");
  EXPECT_EQ(text(0, 12.5, 0), "{ xyz = [0, 0, 150], rpy = [0, 12.5, 0] }");
}

}  // namespace
}  // namespace plumb::offline
