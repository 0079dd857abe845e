// SPDX-License-Identifier: Apache-2.0
#include "arm/effect_binding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string_view>

#include "arm/formula_binding.hpp"
#include "effects/fitted_laws.hpp"
#include "effects/registry.hpp"
#include "plumb/format/limits.hpp"
#include "plumb/runtime/detail/effect_set.hpp"

namespace plumb::offline {
namespace {

bool slides(const format::Chain& arm, int joint) {
  return arm.joints[static_cast<std::size_t>(joint)].type == format::JointType::kPrismatic;
}

std::vector<std::uint8_t> joints_of(const Cell& cell, const EffectEntry& entry,
                                    const EffectInfo& info) {
  const bool sliding = descriptor_of(entry.name).joints == JointList::kSliding;
  std::vector<std::uint8_t> out;
  for (int j : entry.joints) out.push_back(static_cast<std::uint8_t>(j));
  if (!out.empty() || !info.per_joint) return out;
  for (int j = 0; j < cell.joints(); ++j)
    if (slides(cell.nominal, j) == sliding) out.push_back(static_cast<std::uint8_t>(j));
  return out;
}

/// Largest torque of gravity on each joint at the measured poses.
std::vector<double> largest_torques(const Cell& cell, const Measurements& measured) {
  const Chain chain(cell.nominal);
  const format::Mechanics mechanics = mechanics_of(cell);
  const Transformd X_TF = from_pose(cell.nominal.tool).inverse();
  std::vector<double> out(cell.joints(), 0.0);
  ChainFrames frames;
  Loads loads;
  for (Eigen::Index i = 0; i < measured.q.rows(); ++i) {
    chain.frames({measured.q.row(i).data(), static_cast<std::size_t>(cell.joints())}, frames);
    weigh(chain, frames, mechanics, cell.gravity, X_TF, context_at(measured.context, i, {}).known,
          loads);
    for (int j = 0; j < cell.joints(); ++j)
      out[j] = std::max(out[j], std::abs(loads.torque(j, chain, frames)));
  }
  return out;
}

/// Answers what the descriptors of the laws ask of the cell and the measurements.
class DataSource : public ConstantsSource {
 public:
  DataSource(const Cell& cell, const Measurements& measured) : cell_(cell), measured_(measured) {}

  std::vector<double> largest_torques() const override {
    return plumb::offline::largest_torques(cell_, measured_);
  }
  std::optional<Span> time() const override {
    const auto& c = measured_.context;
    const Eigen::VectorXd& t = c.time_s.size() > 0 ? c.time_s : c.order;
    if (t.size() == 0) return std::nullopt;
    return Span{t.minCoeff(), t.maxCoeff()};
  }
  const std::vector<std::string>& sensors() const override { return measured_.context.sensors; }
  std::optional<double> mean_temperature(const std::string& sensor) const override {
    const auto& c = measured_.context;
    const auto at = std::find(c.sensors.begin(), c.sensors.end(), sensor) - c.sensors.begin();
    double sum = 0.0, count = 0.0;
    for (double t : c.temperature.col(at))
      if (std::isfinite(t)) sum += t, count += 1.0;
    return count > 0.0 ? std::optional(sum / count) : std::nullopt;
  }
  bool has_direction() const override { return measured_.context.has_direction(); }
  bool slides(int joint) const override { return plumb::offline::slides(cell_.nominal, joint); }
  Span travel(int joint) const override {
    const auto q = measured_.q.col(joint);
    return {q.minCoeff(), q.maxCoeff()};
  }

 private:
  const Cell& cell_;
  const Measurements& measured_;
};

}  // namespace

format::Effect bind_effect(const Cell& cell, const Measurements& measured,
                           const EffectEntry& entry) {
  if (is_formula(entry.name)) return bind_formula(cell, measured, entry);
  const int law = find_fitted_law(entry.name);
  const EffectInfo& info = fitted_law_info(law);
  format::Effect out;
  out.name = entry.name;
  out.version = info.version;
  out.joints = joints_of(cell, entry, info);
  if (auto* const bind = descriptor_of(entry.name).bind; bind != nullptr)
    bind(entry, DataSource(cell, measured), out);
  const EffectShape shape{cell.joints(), out.joints, out.constants};
  out.parameters.assign(static_cast<std::size_t>(fitted_parameter_count(law, shape)), 0.0);
  return out;
}

std::vector<format::Effect> bind_effects(const Cell& cell, const Measurements& measured) {
  std::vector<format::Effect> out;
  for (const auto& entry : cell.effects)
    if (descriptor_of(entry.name).law != nullptr)  // geometry and local_tree are no laws
      out.push_back(bind_effect(cell, measured, entry));
  if (out.size() > static_cast<std::size_t>(format::kMaxEffects))
    throw Failure(Exit::kInput,
                  {.code = "E-EFFECT-MANY",
                   .message = fmt::format("[effects] lists {} effects; a model holds {}",
                                          out.size(), format::kMaxEffects),
                   .place = Place{.file = cell.file.string()},
                   .help = "drop the weakest: plumb diagnose shows what each explains"});
  return out;
}

std::string unusable_effects(const format::Model& model) {
  const EffectFault fault = find_effect_fault(model);
  if (fault.kind == EffectFault::Kind::kNone) return {};
  if (fault.kind == EffectFault::Kind::kSensors) return "there are too many temperature sensors";
  const format::Effect& effect = model.effects[fault.effect];
  const std::string what = fmt::format("effect '{}' ", effect.name);
  switch (fault.kind) {
    case EffectFault::Kind::kUnknownLaw:
      return what + "is not known to this version";
    case EffectFault::Kind::kNewer:
      return what + fmt::format("is of version {}, newer than this library", effect.version);
    case EffectFault::Kind::kConstants:
      return what + fmt::format("has {} constants, not {}", effect.constants.size(), fault.count);
    case EffectFault::Kind::kFormula:
      return what + "holds code that cannot be run";
    default:
      return what + fmt::format("has {} parameters, not {}", effect.parameters.size(), fault.count);
  }
}

std::vector<std::string> temperature_names(const format::Model& model) {
  std::vector<std::string> out;
  const std::string* name = nullptr;
  for (int k = 0; (name = temperature_name(model, k)) != nullptr; ++k) out.push_back(*name);
  return out;
}

namespace {

/// Vector of every link from its joint to the next one, or to the tip, in the frame after its
/// joint.
std::vector<Vector3> link_vectors(const Cell& cell) {
  const Chain chain(cell.nominal);
  const std::vector<double> zero(static_cast<std::size_t>(chain.joints()), 0.0);
  ChainFrames frames;
  chain.frames(zero, frames);
  std::vector<Vector3> out;
  for (int j = 0; j < chain.joints(); ++j) {
    const Vector3 end = j + 1 == chain.joints() ? frames.tip.p : frames.joint[j + 1].p;
    out.push_back(frames.joint[j].inverse() * end);
  }
  return out;
}

/// Mass of a link as the cell gives it, or that of a uniform bar along the link.
format::LinkMass mass_of(const JointMechanics& m, const Vector3& along) {
  format::LinkMass out;
  if (m.link_com_m) out.com_m = *m.link_com_m;
  if (m.link_mass_kg) {
    out.mass_kg = *m.link_mass_kg;
  } else if (m.kg_per_m) {
    out.mass_kg = *m.kg_per_m * m.length_m.value_or(std::sqrt(dot(along, along)));
    if (!m.link_com_m) out.com_m = {along(0) / 2, along(1) / 2, along(2) / 2};
  }
  return out;
}

}  // namespace

format::Mechanics mechanics_of(const Cell& cell) {
  format::Mechanics out;
  out.payload_kg = cell.payload.mass_kg;
  out.payload_com_m = cell.payload.com_m;
  const auto& mechanics = cell.mechanics;
  if (std::none_of(mechanics.begin(), mechanics.end(), std::mem_fn(&JointMechanics::has_mass)))
    return out;
  const auto along = link_vectors(cell);
  for (std::size_t j = 0; j < mechanics.size(); ++j)
    out.links.push_back(mass_of(mechanics[j], along[j]));
  return out;
}

EffectDomain domain_of(const format::Effect& effect) {
  if (!effect.formula.code.empty()) return static_cast<EffectDomain>(effect.formula.domain);
  return descriptor_of(effect.name).law->domain;
}

namespace {

/// Where a parameter of a law belongs: to a joint, or to the arm, whose parameters follow those of
/// all joints.
struct ParameterPlace {
  int joint = -1;  // index among the joints of the effect; -1: it belongs to the arm
  int place = 0;   // index among the parameters of that joint, or of the arm
};

/// Number of parameters of one of the joints that the effect lists.
int parameters_of_joint(const format::Model& model, const format::Effect& effect,
                        const EffectDescriptor& law, std::size_t joint) {
  if (law.parameters_of_joint == nullptr)
    return law.arm_parameters.empty()
               ? static_cast<int>(effect.parameters.size() / effect.joints.size())
               : static_cast<int>(law.law->parameters.size());
  return law.parameters_of_joint(static_cast<int>(model.calibrated.joints.size()),
                                 effect.joints[joint]);
}

ParameterPlace place_of(const format::Model& model, const format::Effect& effect,
                        const EffectDescriptor& law, int parameter) {
  if (!law.law->per_joint) return {-1, parameter};
  int first = 0;
  for (std::size_t i = 0; i < effect.joints.size(); ++i) {
    const int count = parameters_of_joint(model, effect, law, i);
    if (parameter < first + count) return {static_cast<int>(i), parameter - first};
    first += count;
  }
  return {-1, parameter - first};
}

/// The unit of a factor by which the position of one joint moves another one.
const char* unit_of_ratio(const format::Model& model, const format::Effect& effect) {
  const bool first = slides(model.calibrated, effect.joints[0]);
  const bool second = slides(model.calibrated, effect.joints[1]);
  return first == second ? "1" : first ? "m/rad" : "rad/m";
}

/// Replaces unit and typical size of a parameter by those at a joint that slides.
void fit_to_slide(const format::Model& model, const format::Effect& effect,
                  const EffectDescriptor& law, std::size_t place, EffectParameter& out) {
  if (law.law->per_joint && law.at_slide != nullptr) {
    const std::size_t each = effect.parameters.size() / effect.joints.size();
    if (!slides(model.calibrated, effect.joints[place / each])) return;
    out.unit = law.at_slide->unit;
    out.typical = law.at_slide->typical;
  }
  if (law.joints == JointList::kOrderedPair && std::string_view(out.unit) == "1")
    out.unit = unit_of_ratio(model, effect);
}

/// The name of a parameter without effect and joint.
std::string own_name(const EffectDescriptor& law, const ParameterPlace& at) {
  const auto place = static_cast<std::size_t>(at.place);
  if (law.law->per_joint && at.joint < 0) return law.arm_parameters[place].name;
  return law.parameter_name != nullptr ? law.parameter_name(at.place)
                                       : law.law->parameters[place].name;
}

}  // namespace

EffectParameter effect_parameter(const format::Model& model, int effect, int parameter) {
  const format::Effect& e = model.effects[static_cast<std::size_t>(effect)];
  if (!e.formula.code.empty()) {
    const auto& p = e.formula.parameters[static_cast<std::size_t>(parameter)];
    return {p.name.c_str(), p.unit.c_str(), p.typical, 0.0, 0.0};
  }
  const EffectDescriptor& law = descriptor_of(e.name);
  const auto own = law.law->parameters;
  const auto place = static_cast<std::size_t>(parameter);
  if (!law.arm_parameters.empty() && place >= own.size() * e.joints.size())
    return law.arm_parameters[place - own.size() * e.joints.size()];
  EffectParameter out = own[place % own.size()];
  if (law.typical != nullptr)
    out.typical = law.typical(e, static_cast<int>(place % (e.parameters.size() / e.joints.size())));
  fit_to_slide(model, e, law, place, out);
  return out;
}

std::string effect_parameter_name(const format::Model& model, int effect, int parameter) {
  const format::Effect& e = model.effects[static_cast<std::size_t>(effect)];
  if (!e.formula.code.empty())
    return fmt::format("formula.{}.{}", e.formula.name,
                       e.formula.parameters[static_cast<std::size_t>(parameter)].name);
  const EffectDescriptor& law = descriptor_of(e.name);
  const ParameterPlace at = place_of(model, e, law, parameter);
  const auto joint = [&](std::size_t i) { return model.calibrated.joints[e.joints[i]].name; };
  std::string out = e.name;
  if (at.joint >= 0) out += "." + joint(static_cast<std::size_t>(at.joint));
  if (!law.law->per_joint)
    for (std::size_t i = 0; i < e.joints.size(); ++i) out += "." + joint(i);
  if (law.parameter_infix != nullptr) out += law.parameter_infix(e);
  return out + "." + own_name(law, at);
}

}  // namespace plumb::offline
