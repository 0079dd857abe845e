// SPDX-License-Identifier: Apache-2.0
#include "simulate/joint_law.hpp"

#include <algorithm>
#include <cmath>

namespace plumb::offline::sim {
namespace {

void add_once(std::vector<std::string>& all, const std::vector<std::string>& more) {
  for (const auto& each : more) {
    if (std::find(all.begin(), all.end(), each) == all.end()) all.push_back(each);
  }
}

class JointLaw : public Law {
 public:
  explicit JointLaw(std::vector<JointError> joints) : joints_(std::move(joints)) {}

  void bend(const Moment& now, Deflection& out) const override {
    for (const auto& each : joints_) out.dq(each.at.joint) += each.dq(now);
  }

  nlohmann::ordered_json truth() const override {
    auto out = nlohmann::ordered_json::array();
    for (const auto& each : joints_) {
      nlohmann::ordered_json part{{"joint", each.at.name}, {"size_urad", each.at.size * 1e6}};
      part.update(each.numbers);
      out.push_back(part);
    }
    return out;
  }

  std::vector<std::string> inputs() const override {
    std::vector<std::string> out;
    for (const auto& each : joints_) add_once(out, each.inputs);
    return out;
  }

 private:
  std::vector<JointError> joints_;
};

class ArmLaw : public Law {
 public:
  explicit ArmLaw(ArmBending bending) : bending_(std::move(bending)) {}
  void bend(const Moment& now, Deflection& out) const override { bending_.bend(now, out); }
  nlohmann::ordered_json truth() const override { return bending_.truth; }
  std::vector<std::string> inputs() const override { return bending_.inputs; }

 private:
  ArmBending bending_;
};

}  // namespace

std::unique_ptr<Law> joint_law(std::vector<JointError> joints) {
  return std::make_unique<JointLaw>(std::move(joints));
}

std::unique_ptr<Law> arm_law(ArmBending bending) {
  return std::make_unique<ArmLaw>(std::move(bending));
}

std::vector<bool> turning(const World& world) {
  std::vector<bool> out;
  for (int j = 0; j < world.arm.joints(); ++j) out.push_back(!world.arm.slides(j));
  return out;
}

std::vector<bool> only(const World& world, int j) {
  std::vector<bool> out(static_cast<std::size_t>(world.arm.joints()), false);
  if (j >= 0 && j < world.arm.joints()) out[static_cast<std::size_t>(j)] = true;
  return out;
}

Random joint_random(const World& world, const std::string& law, int joint) {
  return {world.seed, law + " " + std::to_string(joint)};
}

std::string angle_name(int joint) { return "q" + std::to_string(joint + 1); }

double number(const HiddenEffect& effect, const std::string& key, double fallback) {
  const auto found = effect.numbers.find(key);
  return found == effect.numbers.end() ? fallback : found->second;
}

int joint_number(const HiddenEffect& effect, const std::string& key, const World& world,
                 int fallback) {
  const double given = number(effect, key, fallback + 1);
  if (given != std::floor(given) || given < 1.0 || given > world.arm.joints()) {
    refuse(effect, key + " is no joint of this arm");
  }
  return static_cast<int>(given) - 1;
}

void refuse(const HiddenEffect& effect, const std::string& why) {
  throw Failure(Exit::kUsage, {Severity::kError, "E-SIM-JOINT",
                               effect.name + " is not possible on this arm: " + why, std::nullopt,
                               "plumb simulate --list shows the effects"});
}

}  // namespace plumb::offline::sim
