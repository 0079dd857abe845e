// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <string>

#include "cell/assumed_limits.hpp"
#include "cell/cell_sections.hpp"
#include "cell/link_frame.hpp"
#include "cell/rotation.hpp"
#include "cell/unit_sense.hpp"

namespace plumb::offline {
namespace {

class RobotReader {
 public:
  RobotReader(TomlTable& robot, CellDraft& draft) : t_(robot), draft_(draft), cell_(draft.cell) {}

  void read() {
    cell_.robot_name = t_.text_or("name", "");
    units();
    convention();
    joints();
    read_coupling(t_, draft_);
    if (const auto g = t_.vector3("gravity")) cell_.gravity = *g;
    warn_of_gravity(t_, cell_);
    if (auto base = t_.table("base")) cell_.nominal.base = read_pose(*base, draft_);
    if (auto tool = t_.table("tool")) cell_.nominal.tool = read_pose(*tool, draft_);
    payload();
    for (auto& link : t_.tables("links")) read_link(link);
    t_.done();
  }

 private:
  void units() {
    cell_.length_unit = t_.choice("length_unit", {"mm", "m", "um", "in"});
    cell_.angle_unit = t_.choice("angle_unit", {"deg", "rad", "mrad"});
    draft_.length = *unit_of(cell_.length_unit);
    draft_.angle = *unit_of(cell_.angle_unit);
  }

  void convention() {
    if (t_.node("dh_convention") == nullptr)
      return t_.missing("dh_convention",
                        "dh_convention = \"standard\" (distal) or \"modified\" (Craig)");
    if (const char* meant = other_name(t_.text_or("dh_convention", "")))
      return t_.error(
          "E-CELL-RANGE",
          fmt::format("'{}' is \"{}\"", t_.name("dh_convention"), t_.text_or("dh_convention", "")),
          *t_.node("dh_convention"), fmt::format("did you mean \"{}\"?", meant),
          fmt::format("dh_convention = \"{}\"", meant));
    cell_.nominal.convention = t_.choice("dh_convention", {"standard", "modified"}) == "modified"
                                   ? format::Convention::kModified
                                   : format::Convention::kStandard;
  }

  /// Books name the conventions by where the frame sits on the link, or by their authors.
  static const char* other_name(std::string word) {
    for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (word == "craig" || word == "proximal" || word == "khalil" || word == "mdh")
      return "modified";
    if (word == "distal" || word == "classic" || word == "classical" || word == "paul" ||
        word == "spong" || word == "sdh")
      return "standard";
    return nullptr;
  }

  void joints() {
    const toml::node* node = t_.node("joints");
    if (node == nullptr) return t_.missing("joints", "list the joints: plumb new --help");
    auto rows = t_.tables("joints");
    if (node->is_array() &&
        (node->as_array()->empty() || node->as_array()->size() > format::kMaxJoints))
      return t_.out_of_range("joints", fmt::format("1 to {} joints", format::kMaxJoints));
    for (auto& row : rows) joint(row);
    if (!without_limits_.empty())
      t_.source().problems().note(
          "N-CELL-LIMITS",
          fmt::format("no q limits for {}: ±360° or ±10 m are assumed", without_limits_),
          t_.source().place(node->source(), ""), "add q = [min, max] from the data sheet");
  }

  void joint(TomlTable& t) {
    format::JointRow row;
    joint_name(t, row);
    const bool slides = t.choice("type", {"revolute", "prismatic"}) == "prismatic";
    row.type = slides ? format::JointType::kPrismatic : format::JointType::kRevolute;
    const Unit own = slides ? draft_.length : draft_.angle;
    row.alpha = draft_.angle.to_si(t.number_or("alpha", 0.0));
    row.a = draft_.length.to_si(t.number_or("a", 0.0));
    row.d = draft_.length.to_si(t.number_or("d", 0.0));
    row.theta = draft_.angle.to_si(t.number_or("theta", 0.0));
    row.beta = draft_.angle.to_si(t.number_or("beta", 0.0));
    row.offset = own.to_si(t.number_or("offset", 0.0));
    row.scale = t.number_or("scale", 1.0);
    if (row.scale < 0.5 || row.scale > 2.0) t.out_of_range("scale", "between 0.5 and 2");
    limits(t, own, row);
    warn_of_units(t, row, cell_);
    cell_.nominal.joints.push_back(row);
    mechanics(t);
    t.done();
  }

  void joint_name(TomlTable& t, format::JointRow& row) {
    row.name = t.text_or("name", fmt::format("J{}", cell_.nominal.joints.size() + 1));
    if (row.name.empty() || row.name.find_first_of(". ") != std::string::npos)
      t.out_of_range("name", "a word without dots and spaces");
    else if (draft_.joint_index(row.name) >= 0)
      t.out_of_range("name", fmt::format("another: '{}' is already a joint", row.name));
  }

  void limits(TomlTable& t, const Unit& own, format::JointRow& row) {
    const bool slides = row.type == format::JointType::kPrismatic;
    row.q_max = slides ? kAssumedTravel_m : kAssumedTurn;
    row.q_min = -row.q_max;
    cell_.assumed_limits.push_back(t.node("q") == nullptr);
    if (const auto q = t.pair("q")) {
      row.q_min = own.to_si((*q)[0]);
      row.q_max = own.to_si((*q)[1]);
      if (row.q_min >= row.q_max) t.out_of_range("q", "[min, max] with min below max");
    } else if (t.node("q") == nullptr) {
      without_limits_ += (without_limits_.empty() ? "" : ", ") + row.name;
    }
  }

  void mechanics(TomlTable& t) {
    JointMechanics m;
    m.parallel_next = t.boolean("parallel_next").value_or(false);
    m.gear_ratio = t.positive("gear_ratio");
    m.stiffness_Nm_per_rad = t.positive("stiffness_Nm_per_rad");
    cell_.mechanics.push_back(m);
  }

  void payload() {
    auto t = t_.table("payload");
    if (!t) return;
    cell_.payload.mass_kg = t->not_negative("mass_kg").value_or(0.0);
    warn_of_mass(*t, cell_.payload.mass_kg);
    if (const auto com = t->vector3("com_mm")) cell_.payload.com_m = in_mm(*com);
    t->done();
  }

  void read_link(TomlTable& t) {
    JointMechanics m;
    m.link_mass_kg = t.not_negative("mass_kg");
    warn_of_mass(t, m.link_mass_kg);
    const auto com = t.vector3("com_mm");
    const toml::node* com_node = t.node("com_mm");
    const bool of_dh = t.choice("com_frame", {"joint", "dh"}) == "dh";
    if (const auto length = t.positive("length_mm")) m.length_m = unit_of("mm")->to_si(*length);
    m.EI_Nm2 = t.positive("EI_Nm2");
    m.GJ_Nm2 = t.positive("GJ_Nm2");
    m.kg_per_m = t.not_negative("kg_per_m");
    const auto name = t.text("joint");
    const toml::node* node = t.node("joint");
    t.done();
    if (node == nullptr)
      return t.missing("joint", "joint = \"J2\": the joint that moves this link");
    if (!name) return;
    const int index = draft_.joint_index(*name);
    if (index < 0) return unknown_joint(t, *name, *node, draft_);
    if (!linked_.insert(index).second)
      return t.out_of_range("joint", fmt::format("another: '{}' has a link already", *name));
    if (com) {
      m.link_com_m = of_dh ? ahead_of_dh(index, in_mm(*com)) : in_mm(*com);
      warn_of_centre(t, *com_node, of_dh, index, *m.link_com_m);
    }
    m.parallel_next = cell_.mechanics[index].parallel_next;
    m.gear_ratio = cell_.mechanics[index].gear_ratio;
    m.stiffness_Nm_per_rad = cell_.mechanics[index].stiffness_Nm_per_rad;
    cell_.mechanics[index] = m;
  }

  /// A point of the link's Denavit-Hartenberg frame, in the frame that moves with the joint [m].
  std::array<double, 3> ahead_of_dh(int joint, const std::array<double, 3>& point) const {
    const Vector3 out = link_frame(cell_.nominal, joint) * Vector3(point[0], point[1], point[2]);
    return {out(0), out(1), out(2)};
  }

  /// A centre of mass far beside its link is most often given in the other of the two frames. Where
  /// the link of the last joint ends is not known: a tool follows.
  void warn_of_centre(TomlTable& t, const toml::node& node, bool of_dh, int joint,
                      const std::array<double, 3>& com) {
    if (joint + 1 == cell_.joints()) return;
    const Vector3 point(com[0], com[1], com[2]);
    const double away = distance_from_link(cell_.nominal, joint, point);
    if (!(away > widest_link(cell_.nominal, joint))) return;
    t.warning("W-CELL-CENTRE",
              fmt::format("'{}' is {:.0f} mm beside the line from {} to the next joint",
                          t.name("com_mm"), away * 1e3, cell_.nominal.joints[joint].name),
              node, "outside of its link",
              of_dh ? "in the frame that moves with the joint, ahead of d: com_frame = \"joint\""
                    : "in the Denavit-Hartenberg frame of the link, as data sheets have it: "
                      "com_frame = \"dh\"");
  }

  static std::array<double, 3> in_mm(std::array<double, 3> v) {
    for (double& x : v) x = unit_of("mm")->to_si(x);
    return v;
  }

  TomlTable& t_;
  CellDraft& draft_;
  Cell& cell_;
  std::string without_limits_;
  std::set<int> linked_;
};

}  // namespace

format::Pose read_pose(TomlTable& pose, const CellDraft& draft) {
  format::Pose out;
  if (const auto xyz = pose.vector3("xyz"))
    for (int k = 0; k < 3; ++k) out.p[k] = draft.length.to_si((*xyz)[k]);
  if (auto rpy = pose.vector3("rpy")) {
    for (double& angle : *rpy) angle = draft.angle.to_si(angle);
    out.q = quaternion_from_rpy(*rpy);
  }
  pose.done();
  return out;
}

void read_robot(TomlTable& robot, CellDraft& draft) { RobotReader(robot, draft).read(); }

}  // namespace plumb::offline
