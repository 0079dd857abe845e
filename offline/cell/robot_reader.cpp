// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <string>

#include "cell/cell_sections.hpp"
#include "cell/rotation.hpp"
#include "cell/unit_sense.hpp"

namespace plumb::offline {
namespace {

constexpr double kDefaultTurn = 2.0 * M_PI;  // joint limits where none are given [rad]
constexpr double kDefaultTravel_m = 10.0;    // and of a sliding joint

class RobotReader {
 public:
  RobotReader(TomlTable& robot, CellDraft& draft) : t_(robot), draft_(draft), cell_(draft.cell) {}

  void read() {
    cell_.robot_name = t_.text_or("name", "");
    units();
    convention();
    joints();
    if (const auto g = t_.vector3("gravity")) cell_.gravity = *g;
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
    row.q_max = slides ? kDefaultTravel_m : kDefaultTurn;
    row.q_min = -row.q_max;
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
    if (const auto com = t->vector3("com_mm")) cell_.payload.com_m = in_mm(*com);
    t->done();
  }

  void read_link(TomlTable& t) {
    JointMechanics m;
    m.link_mass_kg = t.not_negative("mass_kg");
    if (const auto com = t.vector3("com_mm")) m.link_com_m = in_mm(*com);
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
    m.parallel_next = cell_.mechanics[index].parallel_next;
    m.gear_ratio = cell_.mechanics[index].gear_ratio;
    m.stiffness_Nm_per_rad = cell_.mechanics[index].stiffness_Nm_per_rad;
    cell_.mechanics[index] = m;
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
