// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "bus_text/layout_toml.hpp"
#include "cell/cell.hpp"
#include "cell/cell_sections.hpp"
#include "cell/effects_edit.hpp"
#include "cell/toml_text.hpp"
#include "cell/units.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {
namespace {

namespace fs = std::filesystem;

class CellWriter {
 public:
  explicit CellWriter(const Cell& cell)
      : cell_(cell), length_(*unit_of(cell.length_unit)), angle_(*unit_of(cell.angle_unit)) {}

  std::string write() {
    about();
    robot();
    links();
    for (int i = 0; i < cell_.joints(); ++i) link(i);
    measurement();
    fit();
    effects();
    deploy();
    return std::move(out_);
  }

 private:
  template <class... Args>
  void line(fmt::format_string<Args...> text, Args&&... args) {
    fmt::format_to(std::back_inserter(out_), text, std::forward<Args>(args)...);
    out_ += '\n';
  }

  std::string length(double si) const { return text_in(length_, si); }
  std::string angle(double si) const { return text_in(angle_, si); }
  std::string pose(const format::Pose& p) const { return toml_pose(p, length_, angle_); }

  void about() {
    line("schema = \"cell/1\"\n\n[cell]\nname = {}", toml_string(cell_.name));
    line("serial = {}   # bound into compiled models", toml_string(cell_.serial));
    line("tolerance_mm = {}\n", text_in(mm_, cell_.tolerance_m));
  }

  void robot() {
    const auto& chain = cell_.nominal;
    line("[robot]\nname = {}", toml_string(cell_.robot_name));
    line("dh_convention = \"{}\"   # \"standard\" (distal) or \"modified\" (Craig)",
         chain.convention == format::Convention::kModified ? "modified" : "standard");
    line("length_unit = \"{}\"\nangle_unit = \"{}\"", cell_.length_unit, cell_.angle_unit);
    line("joints = [   # nominal values; q limits in the same unit");
    for (int i = 0; i < cell_.joints(); ++i) joint(i);
    if (any_assumed())
      line("  # without q = [min, max] wide limits are assumed: add those of the data sheet");
    line("]");
    if (!chain.coupling.empty())
      line("coupling = {}   # value of `joint` = its own angle + share x value of `of`",
           toml_coupling(chain));
    line("gravity = {}   # m/s^2 in the base frame", toml_list(cell_.gravity, Unit{}));
    line("base = {}   # rpy: R = Rz(yaw) Ry(pitch) Rx(roll)", pose(chain.base));
    line("tool = {}", pose(chain.tool));
    if (cell_.payload.mass_kg != 0.0 || cell_.payload.com_m != std::array<double, 3>{})
      line("payload = {{ mass_kg = {}, com_mm = {} }}   # in the flange frame",
           text_in(Unit{}, cell_.payload.mass_kg), toml_list(cell_.payload.com_m, mm_));
    else
      line(
          "# payload = {{ mass_kg = 5, com_mm = [0, 0, 100] }}   # centre of mass in the flange "
          "frame; column payload_kg overrides the mass");
    line("");
  }

  bool has_link(int i) const {
    const auto m = mechanics(i);
    return m.link_mass_kg || m.link_com_m || m.length_m || m.EI_Nm2 || m.GJ_Nm2 || m.kg_per_m;
  }

  /// How masses are given, for cells that give none.
  void links() {
    int given = 0;
    for (int i = 0; i < cell_.joints(); ++i) given += has_link(i) ? 1 : 0;
    if (given > 0 || cell_.joints() == 0) return;
    line(
        "# Masses of the links, for gravity; without them `plumb add gravity_free` fits what "
        "gravity does.\n"
        "# The centre of mass is given in the frame right after the joint's motion, ahead of the "
        "d of its link;\n"
        "# with com_frame = \"dh\", in the Denavit-Hartenberg frame of the link, as data sheets "
        "have it.\n"
        "# [[robot.links]]\n# joint = {}\n# mass_kg = 20\n# com_mm = [200, 0, 0]\n",
        toml_string(cell_.nominal.joints[0].name));
  }

  JointMechanics mechanics(int i) const {
    const auto index = static_cast<std::size_t>(i);
    return index < cell_.mechanics.size() ? cell_.mechanics[index] : JointMechanics{};
  }

  bool assumed(int i) const {
    const auto index = static_cast<std::size_t>(i);
    return index < cell_.assumed_limits.size() && cell_.assumed_limits[index];
  }
  bool any_assumed() const {
    return std::find(cell_.assumed_limits.begin(), cell_.assumed_limits.end(), true) !=
           cell_.assumed_limits.end();
  }

  void joint(int i) {
    const auto& row = cell_.nominal.joints[i];
    const auto m = mechanics(i);
    const bool slides = row.type == format::JointType::kPrismatic;
    const Unit& own = slides ? length_ : angle_;
    std::string text =
        fmt::format("name = {}, alpha = {}, a = {}, d = {}, theta = {}", toml_string(row.name),
                    angle(row.alpha), length(row.a), length(row.d), angle(row.theta));
    if (!assumed(i))
      text += fmt::format(", q = [{}, {}]", text_in(own, row.q_min), text_in(own, row.q_max));
    if (slides) text += ", type = \"prismatic\"";
    if (row.beta != 0.0) text += ", beta = " + angle(row.beta);
    if (row.offset != 0.0) text += ", offset = " + text_in(own, row.offset);
    if (row.scale != 1.0) text += ", scale = " + text_in(Unit{}, row.scale);
    if (m.parallel_next) text += ", parallel_next = true";
    if (m.gear_ratio) text += ", gear_ratio = " + text_in(Unit{}, *m.gear_ratio);
    if (m.stiffness_Nm_per_rad)
      text += ", stiffness_Nm_per_rad = " + text_in(Unit{}, *m.stiffness_Nm_per_rad);
    line("  {{ {} }},", text);
  }

  void link(int i) {
    const auto m = mechanics(i);
    if (!has_link(i)) return;
    line("[[robot.links]]\njoint = {}", toml_string(cell_.nominal.joints[i].name));
    if (m.link_mass_kg) line("mass_kg = {}", text_in(Unit{}, *m.link_mass_kg));
    if (m.link_com_m) line("com_mm = {}", toml_list(*m.link_com_m, mm_));
    if (m.length_m) line("length_mm = {}", text_in(mm_, *m.length_m));
    if (m.EI_Nm2) line("EI_Nm2 = {}", text_in(Unit{}, *m.EI_Nm2));
    if (m.GJ_Nm2) line("GJ_Nm2 = {}", text_in(Unit{}, *m.GJ_Nm2));
    if (m.kg_per_m) line("kg_per_m = {}", text_in(Unit{}, *m.kg_per_m));
    line("");
  }

  void measurement() {
    const auto& m = cell_.measurement;
    std::vector<std::string> files;
    for (const auto& file : m.files) files.push_back(relative(file));
    line("[measurement]");
    if (!files.empty() || m.setups.empty()) line("files = {}", toml_list(files));
    line("frame = {}   # base in the tracker frame: \"fit\" or {{ xyz, rpy }}",
         m.fit_frame ? "\"fit\"" : pose(m.X_MB));
    line("target = {}   # reflector in the tool frame: \"fit\" or [x, y, z]",
         m.fit_target ? "\"fit\"" : toml_list(m.target_T, length_));
    if (m.sigma_m)
      line("sigma_um = {}   # 1 sigma per axis", text_in(um_, *m.sigma_m));
    else
      line(
          "# sigma_um = 10   # noise of the tracker, 1 sigma per axis; or columns sx_um, sy_um, "
          "sz_um, or repeats of a pose");
    if (m.sigma_rad) line("sigma_urad = {}", text_in(*unit_of("urad"), *m.sigma_rad));
    if (m.sigma_touch_m) line("sigma_touch_um = {}", text_in(um_, *m.sigma_touch_m));
    if (m.sigma_length_m != MeasurementSettings{}.sigma_length_m)
      line("sigma_distance_um = {}", text_in(um_, m.sigma_length_m));
    line("held_out = {}   # \"auto\", \"20%\", \"kfold:5\", \"column:set\", \"file:verify.csv\"",
         toml_string(held_out()));
    line("seed = {}\n", m.seed);
    for (const auto& one : m.setups)
      if (!one.is_artefact()) setup(one);
  }

  void setup(const Setup& s) {
    const auto same_as = [&](int other) {
      return fmt::format(
          "{{ same_as = {} }}",
          toml_string(cell_.measurement.setups[static_cast<std::size_t>(other)].name));
    };
    line("[[measurement.setup]]\nname = {}", toml_string(s.name));
    std::vector<std::string> files;
    for (const auto& file : s.files) files.push_back(relative(file));
    if (!files.empty()) line("files = {}", toml_list(files));
    line("frame = {}", s.frame_of ? same_as(*s.frame_of) : s.fit_frame ? "\"fit\"" : pose(s.X_MB));
    line("target = {}\n", s.target_of    ? same_as(*s.target_of)
                          : s.fit_target ? "\"fit\""
                                         : toml_list(s.target_T, length_));
  }

  std::string relative(const fs::path& file) const {
    if (cell_.directory.empty()) return file.string();
    return file.lexically_proximate(cell_.directory).string();
  }

  std::string held_out() const {
    const auto& rule = cell_.measurement.held_out;
    switch (rule.kind) {
      case HeldOutRule::Kind::kShare:
        return text_in({Quantity::kNumber, 1.0, 100.0}, rule.share) + "%";
      case HeldOutRule::Kind::kFolds:
        return fmt::format("kfold:{}", rule.folds);
      case HeldOutRule::Kind::kColumn:
        return "column:" + rule.column;
      case HeldOutRule::Kind::kFile:
        return "file:" + relative(rule.file);
      default:
        return "auto";
    }
  }

  void fit() {
    const bool complete = cell_.fit.model == FitSettings::Model::kComplete;
    const FitSettings usual;
    const bool usual_prior =
        cell_.fit.prior_m == usual.prior_m && cell_.fit.prior_rad == usual.prior_rad;
    if (!complete && cell_.fit.fixed.empty() && cell_.fit.priors.empty() &&
        cell_.fit.prior_from.empty() && usual_prior)
      return;
    line("[fit]\nmodel = \"{}\"", complete ? "complete" : "dh");
    if (!cell_.fit.fixed.empty()) line("fixed = {}", toml_list(cell_.fit.fixed));
    std::string priors;
    for (const auto& [name, sigma, mean, of_fleet] : cell_.fit.priors)
      if (!of_fleet)
        priors += fmt::format("{}{} = {}", priors.empty() ? "" : ", ", toml_string(name),
                              is_length_parameter(name) ? length(sigma) : angle(sigma));
    if (!cell_.fit.prior_from.empty())
      line("prior_from = {}   # what other arms of the model taught",
           toml_string(cell_.fit.prior_from));
    if (!priors.empty()) line("prior = {{ {} }}   # 1 sigma around nominal", priors);
    if (!usual_prior)
      line(
          "prior_mm = {:.17g}   # how far arms are built from nominal; 0 = not used\n"
          "prior_mrad = {:.17g}",
          cell_.fit.prior_m * 1e3, cell_.fit.prior_rad * 1e3);
    line("");
  }

  void effects() {
    const bool geometry = !cell_.effects.empty() && is_geometry(cell_.effects.front().name);
    line("[effects]   # what the model contains\ngeometry = {}", geometry);
    for (const auto& effect : cell_.effects)
      if (!is_geometry(effect.name)) write_effect(effect);
    line("");
  }

  void write_effect(const EffectEntry& effect) {
    int count = 0;
    for (const auto& other : cell_.effects) count += other.name == effect.name ? 1 : 0;
    out_ += effect_text(cell_, effect, count > 1);
  }

  void deploy() {
    line("[deploy]\ncycle_us = {}", text_in(us_, cell_.deploy.cycle_s));
    line("max_correction_mm = {}", text_in(mm_, cell_.deploy.max_correction_m));
    const DeploySettings standard;
    if (cell_.deploy.link == drivers::BusUse::kModbus) line("link = \"modbus\"");
    if (cell_.deploy.interface != standard.interface)
      line("interface = {}", toml_string(cell_.deploy.interface));
    if (cell_.deploy.address != standard.address)
      line("address = {}", toml_string(cell_.deploy.address));
    if (cell_.deploy.bus) out_ += "\n" + drivers::write_bus(*cell_.deploy.bus, "deploy.bus");
  }

  const Unit mm_ = *unit_of("mm"), um_ = *unit_of("um"), us_ = *unit_of("us");
  const Cell& cell_;
  Unit length_, angle_;
  std::string out_;
};

}  // namespace

std::string write_cell(const Cell& cell) { return CellWriter(cell).write(); }

}  // namespace plumb::offline
