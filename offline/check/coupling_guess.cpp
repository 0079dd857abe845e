// SPDX-License-Identifier: Apache-2.0
#include "check/coupling_guess.hpp"

#include <array>
#include <cstdint>

namespace plumb::offline {
namespace {

/// Ratios of one pair, and those of neighbours in a wrist. They are what makers build.
constexpr std::array<double, 6> kRatios{-1.0, 1.0, -0.5, 0.5, -2.0, 2.0};
constexpr std::array<double, 3> kShares{-1.0, 0.0, 1.0};

std::vector<std::uint8_t> turning(const format::Chain& arm) {
  std::vector<std::uint8_t> out;
  for (std::size_t j = 0; j < arm.joints.size(); ++j)
    if (arm.joints[j].type == format::JointType::kRevolute)
      out.push_back(static_cast<std::uint8_t>(j));
  return out;
}

/// Three neighbours in every way in which at least two of the pairs are coupled.
void add_triples(const std::vector<std::uint8_t>& joints, std::vector<Couplings>& out) {
  for (std::size_t k = 0; k + 2 < joints.size(); ++k)
    for (const double first : kShares)
      for (const double second : kShares)
        for (const double across : kShares) {
          Couplings all;
          if (first != 0.0) all.push_back({joints[k + 1], joints[k], first});
          if (across != 0.0) all.push_back({joints[k + 2], joints[k], across});
          if (second != 0.0) all.push_back({joints[k + 2], joints[k + 1], second});
          if (all.size() > 1) out.push_back(std::move(all));
        }
}

/// Two pairs of neighbours that have no joint in common.
void add_two_pairs(const std::vector<std::uint8_t>& joints, std::vector<Couplings>& out) {
  for (std::size_t a = 0; a + 1 < joints.size(); ++a)
    for (std::size_t b = a + 2; b + 1 < joints.size(); ++b)
      for (const double first : {-1.0, 1.0})
        for (const double second : {-1.0, 1.0})
          out.push_back({{joints[a + 1], joints[a], first}, {joints[b + 1], joints[b], second}});
}

}  // namespace

std::vector<Couplings> plausible_couplings(const format::Chain& arm) {
  std::vector<Couplings> out;
  const auto joints = turning(arm);
  for (const auto joint : joints)
    for (const auto by : joints)
      for (const double ratio : kRatios)
        if (joint != by) out.push_back({{joint, by, ratio}});
  add_triples(joints, out);
  add_two_pairs(joints, out);
  return out;
}

std::vector<Couplings> neighbour_couplings(const format::Chain& arm) {
  std::vector<Couplings> out;
  const auto joints = turning(arm);
  for (std::size_t k = 1; k < joints.size(); ++k)
    for (const double ratio : {-1.0, 1.0}) out.push_back({{joints[k], joints[k - 1], ratio}});
  return out;
}

Couplings reversed_couplings(Couplings all, const std::vector<bool>& reversed) {
  for (auto& one : all)
    if (reversed[one.joint] != reversed[one.by]) one.ratio = -one.ratio;
  return all;
}

}  // namespace plumb::offline
