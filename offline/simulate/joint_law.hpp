// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "simulate/law.hpp"

namespace plumb::offline::sim {

/// Error of one joint: a formula and its true numbers.
struct JointError {
  SizedJoint at;
  std::function<double(const Moment&)> dq;  // [rad], size included
  nlohmann::ordered_json numbers;           // joint and size are added
  std::vector<std::string> inputs = {};     // see Law::inputs
};

/// dq of every joint by its own formula.
std::unique_ptr<Law> joint_law(std::vector<JointError> joints);

/// Anything else in one piece.
struct ArmBending {
  std::function<void(const Moment&, Deflection&)> bend;
  nlohmann::ordered_json truth;
  std::vector<std::string> inputs = {};
};
std::unique_ptr<Law> arm_law(ArmBending bending);

/// Where a joint turns.
std::vector<bool> turning(const World& world);

/// Everywhere or nowhere but at joint j.
std::vector<bool> only(const World& world, int j);

/// One stream per law and joint: what is drawn for one joint does not depend on which others bend.
Random joint_random(const World& world, const std::string& law, int joint);

/// "q4" for joint 3.
std::string angle_name(int joint);

/// A joint from the numbers of an effect (counted from 1), or `fallback`. Throws Failure (kUsage)
/// if the arm has no such joint.
int joint_number(const HiddenEffect& effect, const std::string& key, const World& world,
                 int fallback);

double number(const HiddenEffect& effect, const std::string& key, double fallback);

/// Refuses an effect that this arm cannot have.
[[noreturn]] void refuse(const HiddenEffect& effect, const std::string& why);

}  // namespace plumb::offline::sim
