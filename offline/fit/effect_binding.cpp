// SPDX-License-Identifier: Apache-2.0
#include "fit/effect_binding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "fit/formula_binding.hpp"
#include "plumb/format/limits.hpp"
#include "plumb/runtime/effect_library.hpp"
#include "plumb/runtime/effect_set.hpp"

namespace plumb::offline {
namespace {

constexpr double kDefaultTransition_rad = 0.01;
constexpr double kTorqueShare = 0.5;  // of the largest: where a soft law turns

[[noreturn]] void refuse(const EffectEntry& entry, const std::string& why,
                         const std::string& help) {
  throw Failure(Exit::kInput, {.code = "E-EFFECT-DATA",
                               .message = fmt::format("effect '{}' {}", entry.name, why),
                               .place = entry.place,
                               .help = help});
}

double option_or(const EffectEntry& entry, const char* key, double fallback) {
  const auto it = entry.options.find(key);
  if (it == entry.options.end()) return fallback;
  const double* number = std::get_if<double>(&it->second);
  return number != nullptr ? *number : fallback;
}

std::string text_or(const EffectEntry& entry, const char* key, std::string fallback) {
  const auto it = entry.options.find(key);
  if (it == entry.options.end()) return fallback;
  const auto* text = std::get_if<std::string>(&it->second);
  return text != nullptr ? *text : fallback;
}

std::vector<std::uint8_t> joints_of(const Cell& cell, const EffectEntry& entry,
                                    const EffectInfo& info) {
  std::vector<std::uint8_t> out;
  for (int j : entry.joints) out.push_back(static_cast<std::uint8_t>(j));
  if (!out.empty() || !info.per_joint) return out;
  for (int j = 0; j < cell.joints(); ++j)
    if (cell.nominal.joints[j].type == format::JointType::kRevolute)
      out.push_back(static_cast<std::uint8_t>(j));
  return out;
}

/// Largest load on each joint at the measured poses.
std::vector<double> largest_torques(const Cell& cell, const Measurements& measured) {
  const Chain chain(cell.nominal);
  const format::Mechanics mechanics = mechanics_of(cell);
  const Transformd X_TF = from_pose(cell.nominal.tool).inverse();
  std::vector<double> out(cell.joints(), 0.0);
  ChainFrames frames;
  Loads loads;
  for (Eigen::Index i = 0; i < measured.q.rows(); ++i) {
    chain.frames({measured.q.row(i).data(), static_cast<std::size_t>(cell.joints())}, frames);
    weigh(chain, frames, mechanics, cell.gravity, X_TF, context_at(measured.context, i, {}), loads);
    for (int j = 0; j < cell.joints(); ++j)
      out[j] = std::max(out[j], std::abs(loads.torque(j, chain, frames)));
  }
  return out;
}

std::vector<double> torque_constants(const Cell& cell, const Measurements& measured,
                                     const EffectEntry& entry,
                                     const std::vector<std::uint8_t>& joints) {
  if (const double given = option_or(entry, "torque_Nm", 0.0); given > 0.0)
    return std::vector<double>(joints.size(), given);
  const auto largest = largest_torques(cell, measured);
  std::vector<double> out;
  for (int j : joints) out.push_back(std::max(1e-6, kTorqueShare * largest[j]));
  return out;
}

std::vector<double> drift_constants(const Measurements& measured, const EffectEntry& entry) {
  const auto& c = measured.context;
  const Eigen::VectorXd& t = c.time_s.size() > 0 ? c.time_s : c.order;
  const double settling = option_or(entry, "settling_s", 0.0);
  if (t.size() == 0) return {0.0, 1.0, settling};
  return {t.minCoeff(), std::max(1e-9, t.maxCoeff() - t.minCoeff()), settling};
}

std::vector<double> step_constants(const EffectEntry& entry) {
  const double row = option_or(entry, "after_row", -1.0);
  if (row < 1.0) refuse(entry, "does not say when", "after_row = 84   # the last row before it");
  const std::string of = text_or(entry, "of", "tool");
  const double code = of == "base" ? 1.0 : of == "joint" ? 2.0 : 0.0;
  return {row - 0.5, code};
}

std::string sensor_of(const EffectEntry& entry, const Measurements& measured) {
  const auto& sensors = measured.context.sensors;
  if (sensors.empty())
    refuse(entry, "needs a temperature column", "measure temp_degC, or temp_NAME_degC");
  const std::string name = text_or(entry, "sensor", sensors.front());
  if (std::find(sensors.begin(), sensors.end(), name) == sensors.end())
    refuse(entry, fmt::format("names sensor '{}'", name),
           fmt::format("sensors of these files: {}", fmt::join(sensors, ", ")));
  return name;
}

double mean_temperature(const Measurements& measured, const std::string& sensor) {
  const auto& c = measured.context;
  const auto at = std::find(c.sensors.begin(), c.sensors.end(), sensor) - c.sensors.begin();
  double sum = 0.0, count = 0.0;
  for (double t : c.temperature.col(at))
    if (std::isfinite(t)) sum += t, count += 1.0;
  return count > 0.0 ? sum / count : 20.0;
}

void bind_constants(const Cell& cell, const Measurements& measured, const EffectEntry& entry,
                    format::Effect& out) {
  using format::ContextInput;
  const auto& name = out.name;
  if (name == "gear_ripple") {
    out.constants = {option_or(entry, "cycles_per_turn", 0.0)};
  } else if (name == "joint_compliance_soft" || name == "backlash_load") {
    out.constants = torque_constants(cell, measured, entry, out.joints);
  } else if (name == "reversal") {
    out.constants = {option_or(entry, "transition_deg", kDefaultTransition_rad * 180 / M_PI) *
                     M_PI / 180};
    out.context = {{ContextInput::kDirection, "", 0.0}};
    if (!measured.context.has_direction())
      refuse(entry, "needs the direction from which each joint came",
             "columns dir_j1 …; if the rows are consecutive moves: plumb import --dir from-order");
  } else if (name == "thermal_growth") {
    const std::string sensor = sensor_of(entry, measured);
    const double reference = option_or(entry, "reference_degC", mean_temperature(measured, sensor));
    out.constants = {reference};
    out.context = {{ContextInput::kTemperature, sensor, reference}};
  } else if (name == "drift") {
    out.constants = drift_constants(measured, entry);
  } else if (name == "step") {
    out.constants = step_constants(entry);
  } else if (name == "gravity_compensator") {
    out.constants = {option_or(entry, "length_ratio", 0.5), option_or(entry, "anchor_ratio", 0.5)};
  }
}

std::string tail(const format::Effect& effect, const EffectInfo& info, int index) {
  const auto each = static_cast<int>(info.parameters.size());
  if (effect.name == "gravity_free") return fmt::format("s{}", index + 1);
  if (effect.name == "joint_table") return fmt::format("t{:03}", index % 120);
  return info.parameters[static_cast<std::size_t>(index % each)].name;
}

}  // namespace

format::Effect bind_effect(const Cell& cell, const Measurements& measured,
                           const EffectEntry& entry) {
  if (entry.name == "formula") return bind_formula(cell, measured, entry);
  const int law = find_effect_law(entry.name);
  const EffectInfo& info = effect_info(law);
  format::Effect out;
  out.name = entry.name;
  out.version = info.version;
  out.joints = joints_of(cell, entry, info);
  bind_constants(cell, measured, entry, out);
  const EffectShape shape{cell.joints(), out.joints, out.constants};
  out.parameters.assign(static_cast<std::size_t>(effect_parameter_count(law, shape)), 0.0);
  return out;
}

std::vector<format::Effect> bind_effects(const Cell& cell, const Measurements& measured) {
  std::vector<format::Effect> out;
  for (const auto& entry : cell.effects)
    if (find_effect_law(entry.name) >= 0)  // not geometry, local_tree
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

/// Of every link, from its joint to the next one or to the tip, in the frame behind its joint.
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

/// A mass of its own, or that of an even bar.
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
  return effect_info(find_effect_law(effect.name)).domain;
}

EffectParameter effect_parameter(const format::Model& model, int effect, int parameter) {
  const format::Effect& e = model.effects[static_cast<std::size_t>(effect)];
  if (!e.formula.code.empty()) {
    const auto& p = e.formula.parameters[static_cast<std::size_t>(parameter)];
    return {p.name.c_str(), p.unit.c_str(), p.typical, 0.0, 0.0};
  }
  const EffectInfo& info = effect_info(find_effect_law(e.name));
  if (e.name == "thermal_growth" && parameter >= static_cast<int>(e.joints.size())) {
    static constexpr EffectParameter kLean{"lean", "rad/K", 5e-6, -1e-3, 1e-3};
    return kLean;
  }
  return info.parameters[static_cast<std::size_t>(parameter) % info.parameters.size()];
}

std::string effect_parameter_name(const format::Model& model, int effect, int parameter) {
  const format::Effect& e = model.effects[static_cast<std::size_t>(effect)];
  if (!e.formula.code.empty())
    return fmt::format("formula.{}.{}", e.formula.name,
                       e.formula.parameters[static_cast<std::size_t>(parameter)].name);
  const EffectInfo& info = effect_info(find_effect_law(e.name));
  std::string out = e.name;
  const auto joint = [&](std::size_t i) { return model.calibrated.joints[e.joints[i]].name; };
  const auto each = static_cast<int>(info.parameters.size());
  if (e.name == "thermal_growth") {
    const int links = static_cast<int>(e.joints.size());
    if (parameter >= links) return out + (parameter == links ? ".lean_x" : ".lean_y");
    return out + "." + joint(static_cast<std::size_t>(parameter)) + ".a";
  }
  if (e.name == "gravity_free" || e.name == "joint_table") {
    std::size_t i = 0;
    int first = 0;
    const auto count = [&](std::size_t k) {
      return e.name == "joint_table"
                 ? 120
                 : 3 * (static_cast<int>(model.calibrated.joints.size()) - e.joints[k]);
    };
    while (parameter >= first + count(i)) first += count(i++);
    return out + "." + joint(i) + "." + tail(e, info, parameter - first);
  }
  if (info.per_joint) out += "." + joint(static_cast<std::size_t>(parameter / each));
  if (!info.per_joint && !e.joints.empty())
    for (std::size_t i = 0; i < e.joints.size(); ++i) out += "." + joint(i);
  if (e.name == "gear_ripple") out += fmt::format(".k{:g}", e.constants[0]);
  if (e.name == "step") out += fmt::format(".row{:g}", e.constants[0] + 0.5);
  return out + "." + tail(e, info, parameter);
}

}  // namespace plumb::offline
