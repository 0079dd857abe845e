// SPDX-License-Identifier: Apache-2.0
#include "urdf/urdf_reader.hpp"

#include <console_bridge/console.h>
#include <fmt/format.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "cell/assumed_limits.hpp"
#include "plumb/format/coupling.hpp"
#include "plumb/format/limits.hpp"
#include "program/bounded_file.hpp"
#include "program/file.hpp"
#include "urdf/dh_conversion.hpp"
#include "urdf/followers.hpp"
#include "urdf/urdf_text.hpp"

namespace plumb::offline {
namespace {

constexpr double kParallelNext = 0.05;  // sine of the angle below which parallel_next is set
constexpr double kGravity = 9.81;       // [m/s^2], as new cells have it
constexpr int kDeepest = 100, kMostLinks = 2000,
              kMostAttributes = 100;  // chosen: no robot has more

Transformd to_transform(const urdf::Pose& pose) {
  double x = 0, y = 0, z = 0, w = 1;
  pose.rotation.getQuaternion(x, y, z, w);
  return from_pose({{pose.position.x, pose.position.y, pose.position.z}, {w, x, y, z}});
}

struct UrdfSize {
  int depth = 0;  // largest depth of nested elements
  int links = 0;
  int attributes = 0;  // largest number of an element
};

/// Measures a text without recursion. The parsers of XML and URDF are recursive and would crash on
/// elements that are nested too deeply.
UrdfSize size_of(std::string_view text) {
  UrdfSize out;
  int depth = 0;
  for (std::size_t at = text.find('<'); at != std::string_view::npos; at = text.find('<', at)) {
    const auto rest = text.substr(at);
    const auto skip_to = [&](std::string_view end) {
      const auto found = text.find(end, at);
      at = found == std::string_view::npos ? text.size() : found + end.size();
    };
    if (rest.starts_with("<!--")) {
      skip_to("-->");
    } else if (rest.starts_with("<![CDATA[")) {
      skip_to("]]>");
    } else if (rest.starts_with("<?") || rest.starts_with("<!")) {
      skip_to(">");
    } else if (rest.starts_with("</")) {
      depth = std::max(0, depth - 1);
      skip_to(">");
    } else {
      if (rest.starts_with("<link")) ++out.links;
      char quote = 0;
      int attributes = 0;
      while (++at < text.size() && (quote != 0 || text[at] != '>'))
        if (quote == 0 && (text[at] == '"' || text[at] == '\''))
          quote = text[at], out.attributes = std::max(out.attributes, ++attributes);
        else if (text[at] == quote)
          quote = 0;
      if (at < text.size() && text[at - 1] != '/') out.depth = std::max(out.depth, ++depth);
    }
  }
  return out;
}

/// Keeps what urdfdom reports to the console during its lifetime, so that a message of Plumb can
/// show it. These reports quote the file.
class ConsoleLines final : public console_bridge::OutputHandler {
 public:
  ConsoleLines() { console_bridge::useOutputHandler(this); }
  ~ConsoleLines() override { console_bridge::restorePreviousOutputHandler(); }
  ConsoleLines(const ConsoleLines&) = delete;
  ConsoleLines& operator=(const ConsoleLines&) = delete;

  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR && first_.empty()) first_ = text;
  }
  const std::string& first_error() const { return first_; }

 private:
  std::string first_;
};

class Reader {
 public:
  Reader(const std::filesystem::path& file, const UrdfEnds& ends)
      : file_(display_name(file)), tip_(ends.tip), base_(ends.base) {
    const std::string text = urdf_text(read_file_up_to(file, kMostUrdfBytes), file_);
    const UrdfSize size = size_of(text);
    if (size.attributes > kMostAttributes)
      fail("E-URDF-SIZE", fmt::format("an element has more than {} attributes", kMostAttributes),
           "export the robot again; plumb needs links, joints, masses and limits only");
    if (size.depth > kDeepest || size.links > kMostLinks)
      fail("E-URDF-SIZE",
           size.depth > kDeepest ? fmt::format("elements are nested more than {} deep", kDeepest)
                                 : fmt::format("the file has more than {} links", kMostLinks),
           "export the robot again; plumb needs links, joints, masses and limits only");
    const ConsoleLines said;
    tree_ = urdf::parseURDF(text);
    if (!tree_)
      fail("E-URDF",
           said.first_error().empty() ? "this is no URDF of a robot"
                                      : "this is no URDF of a robot: " + said.first_error(),
           "export the robot again, or mend that element");
    remarks_ = urdf_unit_warnings(text, file_);
  }

  /// Breaks the ownership between links. Links that form a loop own each other and would never be
  /// freed.
  ~Reader() {
    for (const auto& [name, link] : tree_->links_) {
      link->child_links.clear();
      link->child_joints.clear();
    }
  }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  Cell read(format::Convention convention) {
    check_tree();
    walk();
    if (axes_.empty()) fail("E-URDF-JOINT", "no joint moves between root and tip", tips_help());
    const OwnJoints own = fold_followers();
    if (axes_.size() > static_cast<std::size_t>(format::kMaxJoints))
      fail("E-URDF-JOINT",
           fmt::format("{} joints move, plumb handles {}", axes_.size(), format::kMaxJoints),
           "name a nearer tip: --tip LINK");
    const DhArm arm = to_dh(axes_, X_RL_, convention);
    Cell cell;
    cell.robot_name = cell.name = tree_->getName();
    cell.nominal = arm.chain;
    cell.nominal.coupling = own.coupling;
    for (std::size_t i = 0; i < axes_.size(); ++i) cell.nominal.joints[i].scale = own.scale[i];
    cell.assumed_limits = assumed_;
    if (!base_.empty()) cell.gravity = gravity_in_base(tree_->getLink(base_));
    cell.mechanics.resize(axes_.size());
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      mass_of(i, arm, cell.mechanics[i]);
      if (i + 1 < axes_.size())
        cell.mechanics[i].parallel_next =
            axes_[i].direction.cross(axes_[i + 1].direction).norm() < kParallelNext;
    }
    return cell;
  }

  std::vector<Problem>& remarks() { return remarks_; }

 private:
  struct Mass {
    double kg = 0.0;
    Vector3 first_moment = Vector3::Zero();  // root frame, at zero
  };

  /// Joint `joint` of axes_ moves by `ratio` times the value of the joint of that name.
  struct Leader {
    std::size_t joint = 0;
    std::string leader;
    double ratio = 1.0;
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

  /// Refuses a link that is the child of two joints: the parser keeps only the last one, and the
  /// links behind the other would be lost.
  void check_tree() {
    std::map<std::string, std::vector<std::string>> above;
    for (const auto& [name, joint] : tree_->joints_) above[joint->child_link_name].push_back(name);
    for (const auto& [link, joints] : above)
      if (joints.size() > 1)
        fail("E-URDF",
             fmt::format("link '{}' is the child of several joints: {}", link,
                         fmt::join(joints, ", ")),
             "a URDF is a tree: let every link be the child of one joint");
  }

  /// `path`: from the root, or from the base, to the tip.
  void check_base(const std::vector<urdf::LinkConstSharedPtr>& path) const {
    if (base_.empty() || path.front()->name == base_) return;
    std::vector<std::string> names;
    for (const auto& link : path) names.push_back(link->name);
    names.pop_back();
    fail("E-URDF-BASE",
         fmt::format("link '{}' is not on the way from the root to '{}'", base_, path.back()->name),
         fmt::format("--base {}", fmt::join(names, " or ")));
  }

  /// Gravity points along -z of the root; what moves between root and base stands at zero.
  std::array<double, 3> gravity_in_base(urdf::LinkConstSharedPtr base) const {
    Transformd X_RB;
    for (; base && base->parent_joint; base = base->getParent())
      X_RB = to_transform(base->parent_joint->parent_to_joint_origin_transform) * X_RB;
    const Vector3 down = X_RB.R.transpose() * Vector3(0.0, 0.0, -kGravity);
    std::array<double, 3> out{};
    for (std::size_t k = 0; k < 3; ++k)
      out[k] = std::round(down(static_cast<Eigen::Index>(k)) * 1e9) * 1e-9 + 0.0;
    return out;
  }

  void walk() {
    std::vector<urdf::LinkConstSharedPtr> path;
    for (urdf::LinkConstSharedPtr link = tree_->getLink(tip()); link; link = link->getParent()) {
      path.push_back(link);
      if (link->name == base_) break;
      if (path.size() > tree_->links_.size())
        fail("E-URDF", fmt::format("link '{}' is its own ancestor", link->name),
             "let every link be the child of one joint");
    }
    std::reverse(path.begin(), path.end());
    check_base(path);
    for (const auto& link : path) {
      if (link->parent_joint && link != path.front()) step_over(*link->parent_joint);
      weigh(*link);
      // Links that are fixed rigidly beside the path contribute their mass as well.
      for (const auto& joint : link->child_joints)
        if (joint->type == urdf::Joint::FIXED &&
            std::none_of(path.begin(), path.end(),
                         [&](const auto& l) { return l->name == joint->child_link_name; }))
          weigh_beside(*tree_->getLink(joint->child_link_name),
                       X_RL_ * to_transform(joint->parent_to_joint_origin_transform), 0);
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
    axis.name = joint.name;
    axis.point = X_RL_.p;
    axis.direction = X_RL_.R * Vector3(joint.axis.x, joint.axis.y, joint.axis.z);
    if (!(axis.direction.norm() > 1e-9))
      fail("E-URDF-JOINT", fmt::format("joint '{}' has no axis", joint.name),
           "<axis xyz=\"0 0 1\"/>");
    axis.direction.normalize();
    const bool limited = joint.limits && joint.limits->lower < joint.limits->upper &&
                         joint.type != urdf::Joint::CONTINUOUS;
    const double range =
        axis.type == format::JointType::kRevolute ? kAssumedTurn : kAssumedTravel_m;
    assumed_.push_back(!limited);
    axis.q_min = limited ? joint.limits->lower : -range;
    axis.q_max = limited ? joint.limits->upper : range;
    if (joint.mimic) follow(joint, axis);
    axes_.push_back(axis);
    masses_.emplace_back();
  }

  /// A joint that mimics another stands where it is when the other is at zero.
  void follow(const urdf::Joint& joint, const JointAxis& axis) {
    double ratio = 1.0, offset = 0.0;
    std::string leader;
    std::size_t steps = 0;
    for (const urdf::Joint* one = &joint; one != nullptr && one->mimic;
         one = tree_->getJoint(leader).get()) {
      offset += ratio * one->mimic->offset;
      ratio *= one->mimic->multiplier;
      leader = one->mimic->joint_name;
      if (++steps > tree_->joints_.size()) refuse_mimic(joint.name, "mimics itself");
    }
    X_RL_ = X_RL_ * from_turn(joint, axis.type, offset);
    leaders_.push_back({axes_.size(), leader, ratio});
  }

  /// Motion of a joint in its own frame.
  static Transformd from_turn(const urdf::Joint& joint, format::JointType type, double q) {
    const Vector3 along = Vector3(joint.axis.x, joint.axis.y, joint.axis.z).normalized();
    Transformd out;
    if (type == format::JointType::kPrismatic)
      out.p = q * along;
    else
      out.R = Eigen::AngleAxisd(q, along).toRotationMatrix();
    return out;
  }

  [[noreturn]] void refuse_mimic(const std::string& joint, const std::string& why) const {
    fail("E-URDF-JOINT", fmt::format("joint '{}' {}", joint, why),
         fmt::format("delete its <mimic> element and give the position of '{}' in a column of its "
                     "own; if the arm ends before it, name that link: --tip LINK",
                     joint));
  }

  /// Leaves the joints that have values of their own: the others become their coupling.
  OwnJoints fold_followers() {
    std::vector<Follower> followers;
    for (const Leader& one : leaders_) {
      const auto leader = std::find_if(axes_.begin(), axes_.end(),
                                       [&](const JointAxis& a) { return a.name == one.leader; });
      if (leader == axes_.end())
        refuse_mimic(
            axes_[one.joint].name,
            fmt::format("mimics '{}', which does not move between base and tip", one.leader));
      followers.push_back({one.joint, static_cast<std::size_t>(leader - axes_.begin()), one.ratio});
    }
    OwnJoints own = without_followers(axes_, followers);
    if (!own.left_over.empty()) {
      const Follower& one = *own.left_over.front();
      refuse_mimic(axes_[one.joint].name,
                   fmt::format("mimics '{}' about an axis of its own: only beside a joint that "
                               "moves about the same axis is that a coupling of DH rows",
                               axes_[one.leader].name));
    }
    check_ratios(own, followers);
    say_coupled(own, followers);
    keep_own(own, followers);
    return own;
  }

  /// What cell.toml can hold.
  void check_ratios(const OwnJoints& own, const std::vector<Follower>& followers) const {
    auto ordered = own.coupling;
    bool fits = format::put_in_order(ordered);
    for (const double scale : own.scale) fits = fits && scale >= 0.5 && scale <= 2.0;
    for (const auto& one : own.coupling)
      fits = fits && std::abs(one.ratio) <= format::kMaxCouplingRatio;
    if (fits) return;
    const Follower& one = followers.front();
    refuse_mimic(
        axes_[one.joint].name,
        fmt::format("mimics '{}', and so joints would depend on each other, or move by more "
                    "than {:g} times the value of another or 0.5 to 2 times their own",
                    axes_[one.leader].name, format::kMaxCouplingRatio));
  }

  void say_coupled(const OwnJoints& own, const std::vector<Follower>& followers) {
    for (const Follower& one : followers) {
      const std::string& joint = own.axes[own.own[one.joint]].name;
      const std::string& leader = axes_[one.leader].name;
      remarks_.push_back(
          {.severity = Severity::kNote,
           .code = "N-URDF-MIMIC",
           .message =
               fmt::format("joint '{}' mimics '{}' about the axis of '{}'; its motion became "
                           "{}",
                           axes_[one.joint].name, leader, joint,
                           joint == leader ? "the scale of that joint" : "the coupling of the two"),
           .place = Place{.file = file_},
           .help = fmt::format("the limits of '{}' are those of both motions together; if the "
                               "controller shows their sum, delete the {}",
                               joint, joint == leader ? "scale" : "coupling")});
    }
  }

  /// A link between two joints on one axis is weighed with the one that has a value of its own.
  void keep_own(const OwnJoints& own, const std::vector<Follower>& followers) {
    std::vector<Mass> masses(own.axes.size());
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      masses[own.own[i]].kg += masses_[i].kg;
      masses[own.own[i]].first_moment += masses_[i].first_moment;
    }
    for (const Follower& one : followers) assumed_[one.joint] = assumed_[one.leader];
    std::vector<bool> assumed(own.axes.size());
    for (std::size_t i = 0; i < axes_.size(); ++i)
      assumed[own.own[i]] = assumed[own.own[i]] || assumed_[i];
    masses_ = std::move(masses);
    assumed_ = std::move(assumed);
    axes_ = own.axes;
  }

  void weigh(const urdf::Link& link) { weigh_at(link, X_RL_); }

  void weigh_at(const urdf::Link& link, const Transformd& X_RK) {
    if (!link.inertial || masses_.empty()) return;
    const Vector3 com = X_RK * to_transform(link.inertial->origin).p;
    masses_.back().kg += link.inertial->mass;
    masses_.back().first_moment += com * link.inertial->mass;
  }

  void weigh_beside(const urdf::Link& link, const Transformd& X_RK, std::size_t depth) {
    if (depth > tree_->links_.size())
      fail("E-URDF", fmt::format("link '{}' is its own ancestor", link.name),
           "let every link be the child of one joint");
    weigh_at(link, X_RK);
    for (const auto& joint : link.child_joints)
      weigh_beside(*tree_->getLink(joint->child_link_name),
                   X_RK * to_transform(joint->parent_to_joint_origin_transform), depth + 1);
  }

  void mass_of(std::size_t i, const DhArm& arm, JointMechanics& out) const {
    if (!(masses_[i].kg > 0.0)) return;
    const Vector3 com =
        arm.behind_joint[i].inverse() * Vector3(masses_[i].first_moment / masses_[i].kg);
    out.link_mass_kg = masses_[i].kg;
    out.link_com_m = {com(0), com(1), com(2)};
  }

  std::string file_, tip_, base_;
  urdf::ModelInterfaceSharedPtr tree_;
  std::vector<JointAxis> axes_;
  std::vector<bool> assumed_;  // whether the limits of each axis were assumed
  std::vector<Leader> leaders_;
  std::vector<Problem> remarks_;
  std::vector<Mass> masses_;
  Transformd X_RL_;  // pose of the link reached so far, at joint positions zero
};

}  // namespace

Cell read_urdf(const std::filesystem::path& file, const UrdfEnds& ends,
               format::Convention convention, std::vector<Problem>* remarks) {
  Reader reader(file, ends);
  Cell cell = reader.read(convention);
  if (remarks != nullptr) *remarks = std::move(reader.remarks());
  return cell;
}

}  // namespace plumb::offline
