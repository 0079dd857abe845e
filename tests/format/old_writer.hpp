// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <type_traits>

#include "flatbuffers/flatbuffers.h"
#include "plumb/format/model.hpp"
#include "seal.hpp"

/// Writes a model with the code that flatc made of any schema of the history, field by field and by
/// name. ModelT: its object of the root table; the types of the rest follow from it.
namespace plumb::format::old {

template <class To, class From>
To as(const From& x) {
  return static_cast<To>(x);
}

template <class T>
std::unique_ptr<T> pose(const Pose& x) {
  return std::make_unique<T>(x.p[0], x.p[1], x.p[2], x.q[0], x.q[1], x.q[2], x.q[3]);
}

template <class T>
std::unique_ptr<T> twist(const Twist& x) {
  return std::make_unique<T>(x.d[0], x.d[1], x.d[2], x.e[0], x.e[1], x.e[2]);
}

/// A vector of tables, each made by `make`.
template <class Vector, class Items, class Make>
void fill(Vector& out, const Items& items, Make make) {
  for (const auto& item : items) {
    out.push_back(std::make_unique<typename Vector::value_type::element_type>());
    make(*out.back(), item);
  }
}

template <class T>
void joint(T& out, const JointRow& x) {
  using TwistOf = typename decltype(out.pre)::element_type;
  out.name = x.name;
  out.type = as<decltype(out.type)>(x.type);
  out.alpha = x.alpha;
  out.a = x.a;
  out.d = x.d;
  out.theta = x.theta;
  out.beta = x.beta;
  out.scale = x.scale;
  out.offset = x.offset;
  out.q_min = x.q_min;
  out.q_max = x.q_max;
  out.pre = twist<TwistOf>(x.pre);
  out.post = twist<TwistOf>(x.post);
}

template <class T>
void chain(std::unique_ptr<T>& pointer, const Chain& x) {
  pointer = std::make_unique<T>();
  T& out = *pointer;
  out.convention = as<decltype(out.convention)>(x.convention);
  out.base = pose<typename decltype(out.base)::element_type>(x.base);
  out.base_twist = twist<typename decltype(out.base_twist)::element_type>(x.base_twist);
  fill(out.joints, x.joints, [](auto& to, const auto& from) { joint(to, from); });
  out.tool_twist = twist<typename decltype(out.tool_twist)::element_type>(x.tool_twist);
  out.tool = pose<typename decltype(out.tool)::element_type>(x.tool);
  if constexpr (requires { out.coupling; })
    for (const auto& one : x.coupling) out.coupling.emplace_back(one.ratio, one.joint, one.by);
}

template <class T>
void formula(std::unique_ptr<T>& pointer, const Formula& x) {
  if (x.code.empty()) return;
  pointer = std::make_unique<T>();
  T& out = *pointer;
  out.name = x.name;
  out.target = as<decltype(out.target)>(x.target);
  out.joint = x.joint;
  out.component = x.component;
  out.domain = x.domain;
  out.expression = x.expression;
  out.code = x.code;
  out.literals = x.literals;
  fill(out.parameters, x.parameters, [](auto& to, const auto& from) {
    to.name = from.name;
    to.unit = from.unit;
    to.typical = from.typical;
    to.start = from.start;
  });
}

template <class T>
void effect(T& out, const Effect& x) {
  out.name = x.name;
  out.version = x.version;
  out.joints = x.joints;
  out.parameters = x.parameters;
  fill(out.context, x.context, [](auto& to, const auto& from) {
    to.input = as<decltype(to.input)>(from.input);
    to.name = from.name;
    to.fallback = as<decltype(to.fallback)>(from.fallback);
  });
  out.constants = x.constants;
  formula(out.formula, x.formula);
}

/// Schema 1 was without the last four.
template <class T>
void tree(T& out, const Tree& x) {
  using Node = typename decltype(out.nodes)::value_type;
  out.depth = x.depth;
  for (const auto& n : x.nodes)
    out.nodes.push_back(Node(n.threshold, n.input, n.low, n.high, n.reserved));
  out.coefficients = x.coefficients;
  out.bounds = x.bounds;
  out.blend_half_width = x.blend_half_width;
  if constexpr (requires { out.degree; }) {
    out.degree = x.degree;
    out.directions = x.directions;
    out.region = x.region;
    out.sigma = x.sigma;
  }
}

template <class T>
void mechanics(std::unique_ptr<T>& pointer, const Mechanics& x) {
  pointer = std::make_unique<T>();
  using Link = typename decltype(pointer->links)::value_type;
  for (const auto& l : x.links)
    pointer->links.push_back(Link(l.mass_kg, l.com_m[0], l.com_m[1], l.com_m[2]));
  pointer->payload_kg = x.payload_kg;
  pointer->payload_cx = x.payload_com_m[0];
  pointer->payload_cy = x.payload_com_m[1];
  pointer->payload_cz = x.payload_com_m[2];
}

/// Schema 1 was without ranges of context.
template <class T>
void domain(std::unique_ptr<T>& pointer, const Domain& x) {
  pointer = std::make_unique<T>();
  pointer->q_min = x.q_min;
  pointer->q_max = x.q_max;
  pointer->fade = x.fade;
  if constexpr (requires { pointer->context; })
    fill(pointer->context, x.context, [](auto& to, const auto& from) {
      to.input = as<decltype(to.input)>(from.input);
      to.name = from.name;
      to.low = from.low;
      to.high = from.high;
    });
}

template <class T>
void guard(std::unique_ptr<T>& pointer, const GuardLimits& x) {
  pointer = std::make_unique<T>();
  T& out = *pointer;
  out.corrects = as<decltype(out.corrects)>(x.corrects);
  out.max_correction_m = x.max_correction_m;
  out.max_rotation_rad = x.max_rotation_rad;
  out.slew_m_per_s = x.slew_m_per_s;
  out.slew_rad_per_s = x.slew_rad_per_s;
  out.ramp_s = x.ramp_s;
  out.cycle_s = x.cycle_s;
  out.length_scale_m = x.length_scale_m;
  out.min_singular_value = x.min_singular_value;
  out.max_seed_distance = x.max_seed_distance;
}

template <class T>
void provenance(std::unique_ptr<T>& pointer, const Provenance& x) {
  pointer = std::make_unique<T>();
  T& out = *pointer;
  out.tool_version = x.tool_version;
  out.created = x.created;
  out.run = x.run;
  fill(out.inputs, x.inputs, [](auto& to, const auto& from) {
    to.name = from.name;
    to.sha256 = from.sha256;
  });
  out.poses_fit = x.poses_fit;
  out.held_out = std::make_unique<typename decltype(out.held_out)::element_type>();
  out.held_out->poses = x.held_out.poses;
  out.held_out->mean_m = x.held_out.mean_m;
  out.held_out->rms_m = x.held_out.rms_m;
  out.held_out->p95_m = x.held_out.p95_m;
  out.held_out->max_m = x.held_out.max_m;
  out.noise_floor_m = x.noise_floor_m;
  out.parameter_names = x.parameter_names;
  out.covariance = x.covariance;
}

template <class ModelT>
ModelT model(const Model& x, std::uint32_t schema) {
  ModelT out;
  out.schema_version = schema;
  out.cell_name = x.cell_name;
  out.robot_name = x.robot_name;
  out.serial = x.serial;
  out.gravity_x = x.gravity[0];
  out.gravity_y = x.gravity[1];
  out.gravity_z = x.gravity[2];
  chain(out.nominal, x.nominal);
  chain(out.calibrated, x.calibrated);
  fill(out.effects, x.effects, [](auto& to, const auto& from) { effect(to, from); });
  fill(out.trees, x.trees, [](auto& to, const auto& from) { tree(to, from); });
  domain(out.domain, x.domain);
  guard(out.guard, x.guard);
  provenance(out.provenance, x.provenance);
  mechanics(out.mechanics, x.mechanics);
  return out;
}

/// The flatbuffer of an object, without the trailer of a file.
template <class ModelT>
Bytes packed(const ModelT& object) {
  flatbuffers::FlatBufferBuilder builder;
  builder.Finish(ModelT::TableType::Pack(builder, &object), "PLMB");
  const auto* data = reinterpret_cast<const std::byte*>(builder.GetBufferPointer());
  return {data, data + builder.GetSize()};
}

}  // namespace plumb::format::old
