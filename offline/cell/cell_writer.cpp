// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "cell/cell.hpp"
#include "cell/units.hpp"

namespace plumb::offline {
namespace {

namespace fs = std::filesystem;

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

/// 15 digits: reads well, and back to the nanometre and beyond.
std::string number(double x) { return fmt::format("{:.15g}", x == 0.0 ? 0.0 : x); }

std::string triple(const std::array<double, 3>& v, double unit) {
  return fmt::format("[{}, {}, {}]", number(v[0] / unit), number(v[1] / unit), number(v[2] / unit));
}

std::array<double, 3> rpy(const std::array<double, 4>& q) {
  const auto [w, x, y, z] = q;
  const double sine = std::clamp(2.0 * (w * y - x * z), -1.0, 1.0);
  if (std::abs(sine) > 1.0 - 1e-12)
    return {0.0, std::copysign(M_PI_2, sine), -2.0 * std::copysign(std::atan2(x, w), sine)};
  return {std::atan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y)), std::asin(sine),
          std::atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))};
}

class Writer {
 public:
  explicit Writer(const Cell& cell)
      : cell_(cell),
        length_(unit_of(cell.length_unit)->scale),
        angle_(unit_of(cell.angle_unit)->scale) {}

  std::string write() {
    about();
    robot();
    links();
    measurement();
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

  std::string pose(const format::Pose& p) const {
    return fmt::format("{{ xyz = {}, rpy = {} }}", triple(p.p, length_), triple(rpy(p.q), angle_));
  }

  void about() {
    line("schema = \"cell/1\"\n\n[cell]");
    line("name = {}", quoted(cell_.name));
    line("serial = {}   # bound into compiled models", quoted(cell_.serial));
    line("tolerance_mm = {}\n", number(cell_.tolerance_m * 1e3));
  }

  void robot() {
    const auto& chain = cell_.nominal;
    line("[robot]\nname = {}", quoted(cell_.robot_name));
    line("dh_convention = \"{}\"   # \"standard\" (distal) or \"modified\" (Craig)",
         chain.convention == format::Convention::kModified ? "modified" : "standard");
    line("length_unit = \"{}\"\nangle_unit = \"{}\"", cell_.length_unit, cell_.angle_unit);
    line("joints = [   # nominal values; q limits in the same unit");
    for (int i = 0; i < cell_.joints(); ++i) joint(i);
    line("]");
    line("gravity = {}   # m/s^2 in the base frame", triple(cell_.gravity, 1.0));
    line("base = {}", pose(chain.base));
    line("tool = {}", pose(chain.tool));
    if (cell_.payload.mass_kg > 0)
      line("payload = {{ mass_kg = {}, com_mm = {} }}   # in the flange frame",
           number(cell_.payload.mass_kg), triple(cell_.payload.com_m, 1e-3));
    line("");
  }

  void joint(int i) {
    const auto& r = cell_.nominal.joints[i];
    const auto& m = cell_.mechanics[i];
    const bool slides = r.type == format::JointType::kPrismatic;
    const double own = slides ? length_ : angle_;
    std::string text = fmt::format(
        "  {{ name = {}, alpha = {}, a = {}, d = {}, theta = {}, q = [{}, {}]", quoted(r.name),
        number(r.alpha / angle_), number(r.a / length_), number(r.d / length_),
        number(r.theta / angle_), number(r.q_min / own), number(r.q_max / own));
    if (slides) text += ", type = \"prismatic\"";
    if (r.beta != 0.0) text += ", beta = " + number(r.beta / angle_);
    if (r.offset != 0.0) text += ", offset = " + number(r.offset / own);
    if (r.scale != 1.0) text += ", scale = " + number(r.scale);
    if (m.parallel_next) text += ", parallel_next = true";
    if (m.gear_ratio) text += ", gear_ratio = " + number(*m.gear_ratio);
    if (m.stiffness_Nm_per_rad)
      text += ", stiffness_Nm_per_rad = " + number(*m.stiffness_Nm_per_rad);
    line("{} }},", text);
  }

  void links() {
    for (int i = 0; i < cell_.joints(); ++i) {
      const auto& m = cell_.mechanics[i];
      if (!m.link_mass_kg && !m.link_com_m && !m.length_m && !m.EI_Nm2 && !m.GJ_Nm2 && !m.kg_per_m)
        continue;
      line("[[robot.links]]\njoint = {}", quoted(cell_.nominal.joints[i].name));
      if (m.link_mass_kg) line("mass_kg = {}", number(*m.link_mass_kg));
      if (m.link_com_m) line("com_mm = {}", triple(*m.link_com_m, 1e-3));
      if (m.length_m) line("length_mm = {}", number(*m.length_m * 1e3));
      if (m.EI_Nm2) line("EI_Nm2 = {}", number(*m.EI_Nm2));
      if (m.GJ_Nm2) line("GJ_Nm2 = {}", number(*m.GJ_Nm2));
      if (m.kg_per_m) line("kg_per_m = {}", number(*m.kg_per_m));
      line("");
    }
  }

  void measurement() {
    const auto& m = cell_.measurement;
    line("[measurement]");
    std::string files;
    for (const auto& file : m.files) files += (files.empty() ? "" : ", ") + quoted(relative(file));
    line("files = [{}]", files.empty() ? "\"measurements.csv\"" : files);
    line("frame = {}   # base in the tracker frame", m.fit_frame ? "\"fit\"" : pose(m.X_MB));
    line("target = {}   # reflector in the tool frame",
         m.fit_target ? "\"fit\"" : triple(m.target_T, length_));
    if (m.sigma_m) line("sigma_um = {}   # 1 sigma per axis", number(*m.sigma_m * 1e6));
    if (m.sigma_rad) line("sigma_urad = {}", number(*m.sigma_rad * 1e6));
    line("held_out = {}   # \"auto\", \"20%\", \"kfold:5\", \"column:set\", \"file:verify.csv\"",
         quoted(held_out()));
    line("seed = {}\n", m.seed);
    if (cell_.fit.model == FitSettings::Model::kComplete || !cell_.fit.fixed.empty()) fit();
  }

  std::string relative(const fs::path& file) const {
    return cell_.directory.empty() ? file.string()
                                   : file.lexically_proximate(cell_.directory).string();
  }

  std::string held_out() const {
    const auto& rule = cell_.measurement.held_out;
    switch (rule.kind) {
      case HeldOutRule::Kind::kShare:
        return number(rule.share * 100.0) + "%";
      case HeldOutRule::Kind::kFolds:
        return fmt::format("kfold:{}", rule.folds);
      case HeldOutRule::Kind::kColumn:
        return "column:set";
      case HeldOutRule::Kind::kFile:
        return "file:" + relative(rule.file);
      default:
        return "auto";
    }
  }

  void fit() {
    line("[fit]");
    if (cell_.fit.model == FitSettings::Model::kComplete) line("model = \"complete\"");
    std::string fixed;
    for (const auto& name : cell_.fit.fixed) fixed += (fixed.empty() ? "" : ", ") + quoted(name);
    if (!fixed.empty()) line("fixed = [{}]", fixed);
    line("");
  }

  void effects() {
    const bool geometry = !cell_.effects.empty() && cell_.effects.front().name == "geometry";
    line("[effects]   # what the model contains\ngeometry = {}", geometry);
    for (const auto& effect : cell_.effects) {
      if (effect.name == "geometry") continue;
      line("[effects.{}]", effect.name);
      for (const auto& [key, value] : effect.options)
        if (const auto* x = std::get_if<double>(&value)) line("{} = {}", key, number(*x));
    }
    line("");
  }

  void deploy() {
    line("[deploy]\ncycle_us = {}", number(cell_.deploy.cycle_s * 1e6));
    line("max_correction_mm = {}", number(cell_.deploy.max_correction_m * 1e3));
  }

  const Cell& cell_;
  double length_;
  double angle_;
  std::string out_;
};

}  // namespace

std::string write_cell(const Cell& cell) { return Writer(cell).write(); }

}  // namespace plumb::offline
