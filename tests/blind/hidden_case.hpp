// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "simulate/blind_case.hpp"

namespace plumb::tests {

/// What a case of the study is drawn for; marks are per group.
enum class Group { kNothing, kOne, kWeak, kUnknown, kStep, kThree };

/// One case: what is hidden, and what a right answer would be.
struct HiddenCase {
  Group group = Group::kNothing;
  offline::BlindRequest request;
  struct Answer {
    std::string law;                 // of the simulator
    std::vector<std::string> names;  // what the library may call it, the exact one first
    int joint = -1;                  // zero-based, -1: none
    double sigmas = 0.0;
  };
  std::vector<Answer> hidden;  // largest first
};

/// Draws case `number` of the study with that seed. Cases are balanced over groups, laws, arms and
/// numbers of poses.
HiddenCase draw_case(std::uint64_t study_seed, int number);

const char* name_of(Group group);

}  // namespace plumb::tests
