// SPDX-License-Identifier: Apache-2.0
#include "check/orientation_interpretations.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>

#include "cell/arm_columns.hpp"
#include "cell/euler.hpp"
#include "check/constants.hpp"
#include "check/unit_guess.hpp"

namespace plumb::offline {
namespace {

constexpr std::array<const char*, 4> kQuatNames{"qw", "qx", "qy", "qz"};
constexpr std::array<const char*, 3> kTurnNames{"rx", "ry", "rz"};
constexpr const char* kInverse =
    "they turn the instrument's axes into the reflector's, the inverse of what is meant";

/// The numbers of these columns, row by row [SI]; none if a file lacks one of them.
template <std::size_t N>
std::optional<std::vector<std::array<double, N>>> numbers(const MeasurementFiles& measured,
                                                          const std::vector<int>& rows,
                                                          const std::array<const char*, N>& names) {
  std::vector<std::array<double, N>> all;
  for (const Table& table : measured.tables) {
    std::array<const Column*, N> columns{};
    for (std::size_t k = 0; k < N; ++k) {
      columns[k] = table.find(names[k]);
      if (columns[k] == nullptr) return std::nullopt;
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(table.rows()); ++i) {
      auto& row = all.emplace_back();
      for (std::size_t k = 0; k < N; ++k) row[k] = columns[k]->values[i];
    }
  }
  if (all.empty() || all.size() != static_cast<std::size_t>(measured.size())) return std::nullopt;
  std::vector<std::array<double, N>> out;
  for (const int row : rows) out.push_back(all[static_cast<std::size_t>(row)]);
  return out;
}

template <class Rows, class Make>
Rows4 quaternions(const Rows& rows, const Make& make) {
  Rows4 out(static_cast<Eigen::Index>(rows.size()), 4);
  Eigen::Index at = 0;
  for (const auto& row : rows) {
    const std::array<double, 4> q = make(row);
    out.row(at++) << q[0], q[1], q[2], q[3];
  }
  return out;
}

// ----------------------------------------------------------------------- quaternions

/// Which column holds w, x, y, z, by its place in qw, qx, qy, qz.
struct QuatOrder {
  std::array<std::size_t, 4> at;
  const char* words;
};
constexpr std::array<QuatOrder, 3> kQuatOrders{{{{0, 1, 2, 3}, ""},
                                                {{3, 0, 1, 2}, "qw, qx, qy, qz hold x, y, z, w"},
                                                {{1, 2, 3, 0}, "qx, qy, qz, qw hold w, x, y, z"}}};

NamedInterpretation quat_interpretation(const std::vector<std::array<double, 4>>& rows,
                                        const QuatOrder& order, bool inverse) {
  NamedInterpretation out;
  const double sign = inverse ? -1.0 : 1.0;
  out.interpretation.quat_M = quaternions(rows, [&](const std::array<double, 4>& c) {
    const auto& at = order.at;
    return std::array<double, 4>{c[at[0]], sign * c[at[1]], sign * c[at[2]], sign * c[at[3]]};
  });
  const bool as_named = order.at[0] == 0;
  out.interpretation.changes = (as_named ? 0.0 : 1.0) + (inverse ? check::kInverseCosts : 0.0);
  out.words = order.words;
  if (inverse) out.words += (as_named ? "" : "; ") + std::string(kInverse);
  for (std::size_t k = 0; k < 4; ++k) {
    const std::string held = kQuatNames[order.at[k]];
    if (!as_named) out.edit.names[held] = kQuatNames[k];
    if (inverse && k > 0) out.edit.negated.insert(held);
  }
  return out;
}

std::vector<NamedInterpretation> quat_interpretations(
    const std::vector<std::array<double, 4>>& rows) {
  std::vector<NamedInterpretation> out;
  for (const QuatOrder& order : kQuatOrders)
    for (const bool inverse : {false, true})
      if (inverse || order.at[0] != 0) out.push_back(quat_interpretation(rows, order, inverse));
  return out;
}

// ----------------------------------------------------------------------- three angles

/// Which turns the three columns hold, in which unit and which way.
struct TurnInterpretation {
  EulerConvention convention;
  std::array<std::size_t, 3> column{0, 1, 2};  // that holds the first, second, third turn
  std::string unit;
  bool inverse = false;
};

/// Turns the other way, last one first.
EulerConvention inverse_of(EulerConvention convention) {
  if (!convention.is_vector) convention.moving = !convention.moving;
  return convention;
}

bool is_common(const EulerConvention& c) {
  if (c.is_vector) return true;
  const std::string name = name_of(c);
  return name.starts_with("xyz") || name == "zyx-moving" || name.starts_with("zyz");
}

std::string order_words(const TurnInterpretation& meant) {
  const std::string name = name_of(meant.convention);
  if (meant.convention.is_vector) return "rx, ry, rz hold a rotation vector";
  if (meant.column != std::array<std::size_t, 3>{0, 1, 2})
    return fmt::format("rx, ry, rz turn in the order {}", name);
  if (name == "zyx-moving")
    return "rx, ry, rz hold the turns about z, y, x, as KUKA's A, B, C (zyx-moving)";
  return fmt::format("rx, ry, rz hold the three turns of {}", name);
}

NamedInterpretation turn_interpretation(const std::vector<std::array<double, 3>>& rows,
                                        const TurnInterpretation& labelled,
                                        const TurnInterpretation& meant) {
  NamedInterpretation out;
  const double ratio = unit_ratio(meant.unit, labelled.unit);
  const double factor = meant.inverse ? -ratio : ratio;
  const auto& at = meant.column;
  out.interpretation.quat_M = quaternions(rows, [&](const std::array<double, 3>& c) {
    return quaternion(meant.convention, {factor * c[at[0]], factor * c[at[1]], factor * c[at[2]]});
  });
  const EulerConvention order = meant.inverse ? inverse_of(meant.convention) : meant.convention;
  TurnInterpretation active = meant;
  active.convention = order;
  std::vector<std::string> words;
  double changes = 0.0;
  const bool reordered = at != labelled.column;
  if (order != labelled.convention || reordered) {
    words.push_back(order_words(active));
    changes += reordered          ? check::kOtherColumnsCost
               : is_common(order) ? 1.0
                                  : check::kRareOrderCosts;
  }
  if (meant.unit != labelled.unit) {
    words.push_back(fmt::format("rx, ry, rz are in {}, not {}", meant.unit, labelled.unit));
    changes += 1.0;
  }
  if (meant.inverse) {
    words.emplace_back(kInverse);
    changes += check::kInverseCosts;
  }
  out.words = fmt::format("{}", fmt::join(words, "; "));
  out.interpretation.changes = changes;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string held = kTurnNames[at[k]];
    if (reordered && at[k] != k) out.edit.names[held] = kTurnNames[k];
    if (meant.unit != labelled.unit) out.edit.units[held] = meant.unit;
    if (meant.inverse) out.edit.negated.insert(held);
  }
  if (meant.convention != labelled.convention) out.edit.rotation = name_of(meant.convention);
  return out;
}

/// Every order of turns in which the columns may stand as first, second and third turn; and, where
/// each turns about the axis of its name, every order of these.
std::vector<TurnInterpretation> orders() {
  std::vector<TurnInterpretation> out;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      for (int c = 0; c < 3; ++c)
        for (const bool moving : {false, true}) {
          if (a == b || b == c) continue;
          TurnInterpretation interpretation{
              .convention = {{a, b, c}, moving, false}, .unit = "", .inverse = false};
          out.push_back(interpretation);
          const bool each_once = a != c;
          if (!each_once || !moving || b == 1) continue;
          interpretation.column = {static_cast<std::size_t>(a), static_cast<std::size_t>(b),
                                   static_cast<std::size_t>(c)};
          out.push_back(interpretation);
        }
  out.push_back({.convention = {{0, 1, 2}, false, true}, .unit = "", .inverse = false});
  return out;
}

std::vector<NamedInterpretation> turn_interpretations(
    const std::vector<std::array<double, 3>>& rows, const TurnInterpretation& labelled) {
  std::vector<NamedInterpretation> out;
  const std::string other = labelled.unit == "rad" ? "deg" : "rad";
  for (TurnInterpretation meant : orders())
    for (const std::string& unit : {labelled.unit, other})
      for (const bool inverse : {false, true}) {
        meant.unit = unit;
        meant.inverse = inverse;
        const bool same = meant.convention == labelled.convention &&
                          meant.column == labelled.column && unit == labelled.unit && !inverse;
        if (!same) out.push_back(turn_interpretation(rows, labelled, meant));
      }
  return out;
}

/// What all files say of rx, ry, rz; none if they differ.
std::optional<TurnInterpretation> labelled_turns(const MeasurementFiles& measured) {
  std::optional<TurnInterpretation> out;
  for (const Table& table : measured.tables) {
    const auto convention = stated_rotation(table);
    if (!convention) return std::nullopt;
    for (const char* name : kTurnNames) {
      const TurnInterpretation here{.convention = *convention, .unit = table.find(name)->unit};
      if (out && (out->convention != here.convention || out->unit != here.unit))
        return std::nullopt;
      out = here;
    }
  }
  return out;
}

}  // namespace

std::vector<NamedInterpretation> orientation_interpretations(const MeasurementFiles& measured,
                                                             const std::vector<int>& rows) {
  if (const auto quats = numbers(measured, rows, kQuatNames)) return quat_interpretations(*quats);
  const auto turns = numbers(measured, rows, kTurnNames);
  if (!turns) return {};
  const auto labelled = labelled_turns(measured);
  return labelled ? turn_interpretations(*turns, *labelled) : std::vector<NamedInterpretation>{};
}

}  // namespace plumb::offline
