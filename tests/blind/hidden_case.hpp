// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "simulate/law.hpp"
#include "tests/cases/blind_case.hpp"
#include "tests/random_numbers.hpp"

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
    int also_joint = -1;             // a coupled one, where it may be found as well; -1: none
    double sigmas = 0.0;
  };
  std::vector<Answer> hidden;  // largest first
  // Of the study of inconvenient arms only:
  std::string kind;                  // "joint scatter"
  std::vector<std::string> related;  // effects that are no error there
  bool formulas = false;             // of the study of formulas: what is offered is scored
};

/// Draws case `number` of the study with that seed. Cases are balanced over groups, laws, arms and
/// numbers of poses.
HiddenCase draw_case(std::uint64_t study_seed, int number);

const char* name_of(Group group);

/// The laws from which a group draws.
std::vector<const offline::sim::LawEntry*> laws_of(Group group);

/// A joint of a six-axis arm where the law is usual, or -1 for a law of the whole arm.
int joint_for(const offline::sim::LawEntry& law, Random& random);

/// Adds an effect of that visible size to the request, and the right answer to it.
void hide_at(const offline::sim::LawEntry& law, int joint, double sigmas, Random& random,
             HiddenCase& out);

}  // namespace plumb::tests
