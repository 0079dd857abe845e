// SPDX-License-Identifier: Apache-2.0
#include "plumb/runtime/detail/known_range.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string_view>

#include "lane_choices.hpp"
#include "lanes.hpp"
#include "plumb/runtime/detail/effect_set.hpp"

namespace plumb {
namespace {

constexpr std::size_t kNowhere = sizeof(Context) / sizeof(double);
constexpr std::size_t at(std::size_t bytes) noexcept { return bytes / sizeof(double); }

/// How far outside its range a value may be and still count as inside, and the smallest step in
/// which its distance beyond is counted.
struct Tolerance {
  double margin, step;
};

Tolerance tolerance(const format::ContextRange& range) noexcept {
  const std::string_view name = range.name;
  if (range.input == format::ContextInput::kTemperature) return {5.0, 10.0};
  const double size = std::max(range.high, -range.low);
  if (name.empty()) return {std::max(0.1 * size, 0.1), std::max(0.5 * size, 1.0)};
  if (name[0] == 'c') return {0.01, 0.05};
  const bool force = name[0] == 'f';
  return {std::max(0.1 * size, force ? 1.0 : 0.1), std::max(0.5 * size, force ? 10.0 : 1.0)};
}

/// The position of the input in a context, counted in numbers.
std::size_t place_of(const format::Model& model, const format::ContextRange& range) noexcept {
  if (range.input == format::ContextInput::kTemperature) {
    const std::string* name = nullptr;
    for (int k = 0; (name = temperature_name(model, k)) != nullptr; ++k)
      if (*name == range.name && k < format::kMaxTemperatures)
        return at(offsetof(Context, temperature_degC)) + static_cast<std::size_t>(k);
    return kNowhere;
  }
  if (range.name.empty()) return at(offsetof(Context, payload_kg));
  const auto axis = static_cast<std::size_t>(range.name[1] - 'x');
  if (range.name[0] == 'c') return at(offsetof(Context, payload_com_m)) + axis;
  if (range.name[0] == 'f') return at(offsetof(Context, force_N)) + axis;
  return at(offsetof(Context, moment_Nm)) + axis;
}

double magnitude(double x) noexcept { return x < 0.0 ? -x : x; }

/// The weight of the correction: 1 up to one step outside, then falling smoothly to 0.
double weight(double steps) noexcept {
  const double x = 1.0 - (steps - 1.0) * (1.0 / KnownRange::kFadingSteps);
  const double held = std::min(std::max(x, 0.0), 1.0);
  return held * held * (3.0 - 2.0 * held);
}

}  // namespace

KnownRange::KnownRange(const format::Model& model) noexcept {
  const auto& d = model.domain;
  const std::size_t n = std::min(d.q_min.size(), d.q_max.size());
  for (std::size_t i = 0; i < std::min<std::size_t>(n, format::kMaxJoints); ++i)
    add_joint(model, i);
  for (const auto& range : d.context)
    if (ranges_ < context_.size()) add_range(model, range);
}

void KnownRange::add_joint(const format::Model& model, std::size_t i) noexcept {
  const auto& d = model.domain;
  const bool slides = i < model.nominal.joints.size() &&
                      model.nominal.joints[i].type == format::JointType::kPrismatic;
  const double unit = slides ? model.guard.length_scale_m : 1.0;
  const double span = d.q_max[i] - d.q_min[i];
  mid_[i] = 0.5 * (d.q_min[i] + d.q_max[i]);
  half_[i] = 0.5 * span + kEdge * unit;
  per_step_[i] = 1.0 / std::max(d.fade * span, kLeastStep * unit);
  joints_ = i + 1;
}

void KnownRange::add_range(const format::Model& model, const format::ContextRange& range) noexcept {
  const Tolerance allowed = tolerance(range);
  const double span = range.high - range.low;
  context_[ranges_++] = {.place = place_of(model, range),
                         .mid = 0.5 * (range.low + range.high),
                         .half = 0.5 * span + allowed.margin,
                         .per_step = 1.0 / std::max(span, allowed.step)};
}

KnownRange::Found KnownRange::look(std::span<const double> q,
                                   const Context& context) const noexcept {
  const std::size_t n = std::min(joints_, q.size());
  Packed farthest = packed(0.0);
  for (std::size_t i = 0; i < n; i += kPackedLanes) {
    const Packed way = plumb::magnitude(load_some(&q[i], n - i) - load(&mid_[i]));
    const Packed beyond = (way - load(&half_[i])) * load(&per_step_[i]);
    farthest = beyond > farthest ? beyond : farthest;
  }
  double steps = 0.0;
  for (std::size_t lane = 0; lane < kPackedLanes; ++lane) steps = std::max(steps, farthest[lane]);
  for (std::size_t k = 0; k < ranges_; ++k) {
    const Range& range = context_[k];
    const double beyond = magnitude(value(k, context) - range.mid) - range.half;
    if (beyond * range.per_step > steps) steps = beyond * range.per_step;  // false for NaN
  }
  if (!(steps > 0.0)) return {};
  return {.outside = true, .weight = weight(steps)};
}

bool KnownRange::joint_outside(std::size_t joint, double q) const noexcept {
  return joint < joints_ && magnitude(q - mid_[joint]) > half_[joint];
}

bool KnownRange::context_outside(std::size_t range, const Context& context) const noexcept {
  return range < ranges_ &&
         magnitude(value(range, context) - context_[range].mid) > context_[range].half;
}

double KnownRange::value(std::size_t range, const Context& context) const noexcept {
  if (range >= ranges_ || context_[range].place >= kNowhere) return kUnknown;
  double out;
  std::memcpy(&out,
              reinterpret_cast<const std::byte*>(&context) + context_[range].place * sizeof out,
              sizeof out);
  return out;
}

}  // namespace plumb
