// SPDX-License-Identifier: Apache-2.0
#include "urdf/urdf_reader.hpp"

#include <fmt/format.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "program/file.hpp"
#include "urdf/dh_conversion.hpp"

namespace plumb::offline {
namespace {

constexpr double kNearParallel = 0.05;  // sine: `parallel_next`
constexpr double kWholeTurn = 2.0 * M_PI;

Transformd to_transform(const urdf::Pose& pose) {
  double x = 0, y = 0, z = 0, w = 1;
  pose.rotation.getQuaternion(x, y, z, w);
  return from_pose({{pose.position.x, pose.position.y, pose.position.z}, {w, x, y, z}});
}

class Reader {
 public:
  Reader(const std::filesystem::path& file, std::string tip)
      : file_(display_name(file)), tip_(std::move(tip)) {
    // urdfdom reports to the console; what it says is our message.
    tree_ = urdf::parseURDF(read_file(file));
    if (!tree_) fail("E-URDF", "this is no URDF of a robot", "check_urdf names the broken element");
  }

  Cell read(format::Convention convention) {
    walk();
    if (axes_.empty()) fail("E-URDF-JOINT", "no joint moves between root and tip", tips_help());
    if (axes_.size() > static_cast<std::size_t>(format::kMaxJoints))
      fail("E-URDF-JOINT",
           fmt::format("{} joints move, plumb handles {}", axes_.size(), format::kMaxJoints),
           "name a nearer tip: --tip LINK");
    const DhArm arm = to_dh(axes_, X_RL_, convention);
    Cell cell;
    cell.robot_name = cell.name = tree_->getName();
    cell.nominal = arm.chain;
    cell.mechanics.resize(axes_.size());
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      mass_of(i, arm, cell.mechanics[i]);
      if (i + 1 < axes_.size())
        cell.mechanics[i].parallel_next =
            axes_[i].direction.cross(axes_[i + 1].direction).norm() < kNearParallel;
    }
    return cell;
  }

 private:
  struct Mass {
    double kg = 0.0;
    Vector3 first_moment = Vector3::Zero();  // root frame, at zero
  };

  [[noreturn]] void fail(const char* code, std::string message, std::string help) const {
    throw Failure(Exit::kInput, {.code = code,
                                 .message = std::move(message),
                                 .place = Place{.file = file_},
                                 .help = std::move(help)});
  }

  std::vector<std::string> leaves() const {
    std::vector<std::string> out;
    for (const auto& [name, link] : tree_->links_)
      if (link->child_joints.empty()) out.push_back(name);
    return out;
  }

  std::string tips_help() const { return fmt::format("--tip {}", fmt::join(leaves(), " or ")); }

  std::string tip() const {
    const auto all = leaves();
    if (tip_.empty() && all.size() == 1) return all.front();
    if (tip_.empty())
      fail("E-URDF-TIP", fmt::format("the file has {} tips: {}", all.size(), fmt::join(all, ", ")),
           tips_help());
    if (tree_->getLink(tip_)) return tip_;
    std::vector<std::string> names;
    for (const auto& [name, link] : tree_->links_) names.push_back(name);
    const auto guess = did_you_mean(tip_, names);
    fail("E-URDF-TIP", fmt::format("the file has no link '{}'", tip_),
         guess ? fmt::format("did you mean '{}'?", *guess) : tips_help());
  }

  void walk() {
    std::vector<urdf::LinkConstSharedPtr> path;
    for (urdf::LinkConstSharedPtr link = tree_->getLink(tip()); link; link = link->getParent())
      path.push_back(link);
    std::reverse(path.begin(), path.end());
    for (const auto& link : path) {
      if (link->parent_joint) step_over(*link->parent_joint);
      weigh(*link);
      // What hangs rigidly beside the path weighs as well.
      for (const auto& joint : link->child_joints)
        if (joint->type == urdf::Joint::FIXED &&
            std::none_of(path.begin(), path.end(),
                         [&](const auto& l) { return l->name == joint->child_link_name; }))
          weigh_beside(*tree_->getLink(joint->child_link_name),
                       X_RL_ * to_transform(joint->parent_to_joint_origin_transform));
    }
  }

  void step_over(const urdf::Joint& joint) {
    X_RL_ = X_RL_ * to_transform(joint.parent_to_joint_origin_transform);
    JointAxis axis;
    switch (joint.type) {
      case urdf::Joint::FIXED:
        return;
      case urdf::Joint::REVOLUTE:
      case urdf::Joint::CONTINUOUS:
        axis.type = format::JointType::kRevolute;
        break;
      case urdf::Joint::PRISMATIC:
        axis.type = format::JointType::kPrismatic;
        break;
      default:
        fail("E-URDF-JOINT",
             fmt::format("joint '{}' is neither revolute, prismatic nor fixed", joint.name),
             "plumb calibrates serial arms; name another tip: --tip LINK");
    }
    if (joint.mimic)
      fail("E-URDF-JOINT", fmt::format("joint '{}' mimics another one", joint.name),
           "plumb calibrates serial arms; name another tip: --tip LINK");
    axis.name = joint.name;
    axis.point = X_RL_.p;
    axis.direction = X_RL_.R * Vector3(joint.axis.x, joint.axis.y, joint.axis.z);
    if (!(axis.direction.norm() > 1e-9))
      fail("E-URDF-JOINT", fmt::format("joint '{}' has no axis", joint.name),
           "<axis xyz=\"0 0 1\"/>");
    axis.direction.normalize();
    const bool limited = joint.limits && joint.limits->lower < joint.limits->upper &&
                         joint.type != urdf::Joint::CONTINUOUS;
    const double range = axis.type == format::JointType::kRevolute ? kWholeTurn : 10.0;
    axis.q_min = limited ? joint.limits->lower : -range;
    axis.q_max = limited ? joint.limits->upper : range;
    axes_.push_back(axis);
    masses_.emplace_back();
  }

  void weigh(const urdf::Link& link) { weigh_at(link, X_RL_); }

  void weigh_at(const urdf::Link& link, const Transformd& X_RK) {
    if (!link.inertial || masses_.empty()) return;
    const Vector3 com = X_RK * to_transform(link.inertial->origin).p;
    masses_.back().kg += link.inertial->mass;
    masses_.back().first_moment += com * link.inertial->mass;
  }

  void weigh_beside(const urdf::Link& link, const Transformd& X_RK) {
    weigh_at(link, X_RK);
    for (const auto& joint : link.child_joints)
      weigh_beside(*tree_->getLink(joint->child_link_name),
                   X_RK * to_transform(joint->parent_to_joint_origin_transform));
  }

  void mass_of(std::size_t i, const DhArm& arm, JointMechanics& out) const {
    if (!(masses_[i].kg > 0.0)) return;
    const Vector3 com =
        arm.behind_joint[i].inverse() * Vector3(masses_[i].first_moment / masses_[i].kg);
    out.link_mass_kg = masses_[i].kg;
    out.link_com_m = {com(0), com(1), com(2)};
  }

  std::string file_, tip_;
  urdf::ModelInterfaceSharedPtr tree_;
  std::vector<JointAxis> axes_;
  std::vector<Mass> masses_;
  Transformd X_RL_;  // of the link reached, at zero
};

}  // namespace

Cell read_urdf(const std::filesystem::path& file, const std::string& tip,
               format::Convention convention) {
  return Reader(file, tip).read(convention);
}

}  // namespace plumb::offline
