// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "simulate/law.hpp"

namespace plumb::offline::sim {

/// The error of one joint: a formula and its true numbers.
struct JointError {
  SizedJoint at;
  std::function<double(const Moment&)> dq;  // error of the joint, including the size [rad]
  nlohmann::ordered_json numbers;           // without joint and size, which are added
  std::vector<std::string> inputs = {};     // see Law::inputs
};

/// A law with a separate formula for each joint.
std::unique_ptr<Law> joint_law(std::vector<JointError> joints);

/// A law that acts on the whole arm.
// NOLINTNEXTLINE(bugprone-exception-escape): the JSON library's null constructor is taken to throw
struct ArmBending {
  std::function<void(const Moment&, Deflection&)> bend;
  nlohmann::ordered_json truth;
  std::vector<std::string> inputs = {};
};
std::unique_ptr<Law> arm_law(ArmBending bending);

/// For each joint, whether it is revolute.
std::vector<bool> turning(const World& world);

/// A list that is true for joint j only, or nowhere if the arm has no joint j.
std::vector<bool> only(const World& world, int j);

/// A random stream for this law and joint, so that what is drawn for one joint does not depend on
/// which other joints are affected.
Random joint_random(const World& world, const std::string& law, int joint);

/// The name of the angle of a joint: "q4" for joint 3.
std::string angle_name(int joint);

/// The joint that the number `key` of an effect states (counted from 1), or `fallback` if it is not
/// given. Throws Failure (kUsage) if the arm has no such joint.
int joint_number(const HiddenEffect& effect, const std::string& key, const World& world,
                 int fallback);

double number(const HiddenEffect& effect, const std::string& key, double fallback);

/// Throws Failure (kUsage) for an effect that this arm cannot have.
[[noreturn]] void refuse(const HiddenEffect& effect, const std::string& why);

}  // namespace plumb::offline::sim
