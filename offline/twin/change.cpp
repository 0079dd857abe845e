// SPDX-License-Identifier: Apache-2.0
#include "twin/change.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>

#include "cell/units.hpp"
#include "simulate/arm.hpp"
#include "simulate/random.hpp"

namespace plumb::offline::twin {
namespace {

using Of = Change::Of;

constexpr double kAlways_s = -1.0;  // before the first reading

struct Kind {
  const char* name;
  Of of;
  bool of_joint;
  const char* example;
};
constexpr Kind kKinds[] = {{"encoder", Of::kEncoder, true, "encoder:J2=120urad"},
                           {"stiffness", Of::kStiffness, true, "stiffness:J3=-15%"},
                           {"tool", Of::kTool, false, "tool=0.2mm or tool=0.1,0,-0.2mm"},
                           {"base", Of::kBase, false, "base=0.3mm or base=0.3,0,-0.1mm"}};

/// A number and what stands behind it.
struct Sized {
  double number = 0.0;
  std::string unit;
};

/// Reads one change, and shows mistakes where they stand.
class ChangeReader {
 public:
  ChangeReader(const std::string& text, const Cell& cell) : text_(text), cell_(cell) {}

  Change read(std::uint64_t seed) const {
    const std::size_t equals = std::min(text_.find('='), text_.size());
    const std::size_t colon = std::min(text_.find(':'), equals);
    const Kind& kind = kind_of(colon);
    const bool names_joint = colon < equals;
    if (names_joint != kind.of_joint)
      fail(0, equals, kind.of_joint ? "which joint?" : "this is of no joint", kind.example);
    if (equals == text_.size()) fail(0, equals, "no size is given", kind.example);
    Change out{.of = kind.of};
    if (kind.of_joint) out.joint = joint_at(colon + 1, equals);
    if (kind.of == Of::kEncoder) out.size = quantity_at(equals + 1, Quantity::kAngle, kind);
    if (kind.of == Of::kStiffness) out.size = share_at(equals + 1, kind);
    if (!kind.of_joint) out.shift_m = shift_at(equals + 1, kind, seed);
    return out;
  }

 private:
  const Kind& kind_of(std::size_t end) const {
    std::vector<std::string> names;
    for (const auto& kind : kKinds) {
      if (text_.compare(0, end, kind.name) == 0) return kind;
      names.emplace_back(kind.name);
    }
    const auto near = did_you_mean(text_.substr(0, end), names);
    fail(0, end, fmt::format("no change is called '{}'", text_.substr(0, end)),
         near ? fmt::format("did you mean '{}'?", *near)
              : fmt::format("known: {}", fmt::join(names, ", ")));
  }

  int joint_at(std::size_t begin, std::size_t end) const {
    const std::string name = text_.substr(begin, end - begin);
    std::vector<std::string> names;
    for (const auto& row : cell_.nominal.joints) {
      names.push_back(row.name);
      if (row.name != name) continue;
      if (row.type == format::JointType::kRevolute) return static_cast<int>(names.size()) - 1;
      fail(begin, end, name + " slides", "name a joint that turns");
    }
    fail(begin, end, fmt::format("the arm has no joint '{}'", name),
         fmt::format("known: {}", fmt::join(names, ", ")));
  }

  Sized sized_at(std::size_t begin, const Kind& kind) const {
    Sized out;
    const char* const end = text_.data() + text_.size();
    const char* first = text_.data() + begin;
    if (first != end && *first == '+') ++first;
    const auto [rest, error] = std::from_chars(first, end, out.number);
    if (error != std::errc() || !std::isfinite(out.number))
      fail(begin, text_.size(), "a number with a unit stands here", kind.example);
    out.unit.assign(rest, end);
    return out;
  }

  double quantity_at(std::size_t begin, Quantity quantity, const Kind& kind) const {
    const auto [number, name] = sized_at(begin, kind);
    return number * factor(begin, name, quantity, kind);
  }

  double factor(std::size_t begin, const std::string& name, Quantity quantity,
                const Kind& kind) const {
    const auto unit = unit_of(name);
    if (!unit || unit->quantity != quantity)
      fail(begin, text_.size(), fmt::format("'{}' is no unit of this", name), kind.example);
    return unit->to_si(1.0);
  }

  double share_at(std::size_t begin, const Kind& kind) const {
    const auto [number, unit] = sized_at(begin, kind);
    if (unit != "%" || number <= -100.0)
      fail(begin, text_.size(), "a change of the stiffness is a share above -100 %", kind.example);
    return number / 100.0;
  }

  /// One length, or three with the unit of all at the end.
  std::array<double, 3> shift_at(std::size_t begin, const Kind& kind, std::uint64_t seed) const {
    std::array<double, 3> out{};
    Sized last = sized_at(begin, kind);
    std::size_t count = 0;
    for (std::size_t at = begin; count < 3; at = text_.size() - last.unit.size() + 1) {
      last = sized_at(at, kind);
      out[count++] = last.number;
      if (!last.unit.starts_with(',')) break;
    }
    if (count == 2 || last.unit.starts_with(','))
      fail(begin, text_.size(), "a shift is one length, or three along x, y and z", kind.example);
    const double m = factor(begin, last.unit, Quantity::kLength, kind);
    if (count == 1) {
      const Eigen::Vector3d way = out[0] * sim::Random(seed, kind.name).direction();
      out = {way.x(), way.y(), way.z()};
    }
    for (double& each : out) each *= m;
    return out;
  }

  [[noreturn]] void fail(std::size_t begin, std::size_t end, const std::string& message,
                         const std::string& help) const {
    Place place{.file = "--change",
                .line = 1,
                .column = static_cast<int>(begin) + 1,
                .length = std::max(1, static_cast<int>(end) - static_cast<int>(begin)),
                .source = text_};
    throw Failure(Exit::kUsage,
                  {.code = "E-TWIN-CHANGE", .message = message, .place = place, .help = help});
  }

  const std::string& text_;
  const Cell& cell_;
};

bool is_spring(const HiddenEffect& effect) {
  return effect.name == "joint_compliance" || effect.name == "joint_compliance_soft";
}

/// An angle under load is inverse to the stiffness.
void change_stiffness(const Change& change, const Cell& cell, HiddenTruth& truth) {
  std::vector<std::string> soft;
  for (auto& effect : truth.sized) {
    if (!is_spring(effect)) continue;
    for (auto& part : effect.joints) {
      const std::optional<double> size = part.size ? part.size : effect.size;
      if (!size) continue;
      soft.push_back(cell.nominal.joints[static_cast<std::size_t>(part.joint)].name);
      if (part.joint != change.joint) continue;
      part.size = *size / (1.0 + change.size);
      return;
    }
  }
  throw Failure(
      Exit::kUsage,
      {.code = "E-TWIN-CHANGE",
       .message = fmt::format("{} of this arm is stiff, so its stiffness cannot change",
                              cell.nominal.joints[static_cast<std::size_t>(change.joint)].name),
       .help = soft.empty() ? "an arm whose joints yield: plumb demo compliance cell"
                            : fmt::format("joints that yield: {}", fmt::join(soft, ", "))});
}

void move_base(const std::array<double, 3>& shift_m, HiddenTruth& truth) {
  sim::Isometry3d X_MB = sim::to_isometry(truth.X_MB.value());
  X_MB.translate(sim::Vector3d(shift_m.data()));
  truth.X_MB = sim::to_pose(X_MB);
}

void move_tool(const std::array<double, 3>& shift_m, HiddenTruth& truth) {
  for (std::size_t k = 0; k < 3; ++k) truth.target_T.value()[k] += shift_m[k];
}

void shift_encoder(const Change& change, HiddenTruth& truth) {
  HiddenEffect slip;
  slip.name = "step_encoder";
  slip.joints = {{change.joint, change.size}};
  slip.numbers = {{"at_s", kAlways_s}};
  truth.sized.push_back(std::move(slip));
}

}  // namespace

Change parse_change(const std::string& text, const Cell& cell, std::uint64_t seed) {
  return ChangeReader(text, cell).read(seed);
}

void apply(const Change& change, const Cell& cell, HiddenTruth& truth) {
  switch (change.of) {
    case Of::kEncoder:
      return shift_encoder(change, truth);
    case Of::kStiffness:
      return change_stiffness(change, cell, truth);
    case Of::kTool:
      return move_tool(change.shift_m, truth);
    case Of::kBase:
      return move_base(change.shift_m, truth);
  }
}

}  // namespace plumb::offline::twin
