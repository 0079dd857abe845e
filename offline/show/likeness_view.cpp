// SPDX-License-Identifier: Apache-2.0
#include "show/likeness_view.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cell/earlier_arm.hpp"
#include "program/file.hpp"
#include "show/parameter_unit.hpp"
#include "show/units.hpp"

namespace plumb::offline::show {
namespace {

/// By how much the one number that differs does: "+0.050 deg".
std::string change_words(const EarlierArm& earlier, const Calibration& found,
                         const std::string& name) {
  const auto now = std::find_if(found.estimates.begin(), found.estimates.end(),
                                [&](const Estimate& e) { return e.name == name; });
  const auto then = std::find_if(earlier.numbers.begin(), earlier.numbers.end(),
                                 [&](const auto& n) { return n.name == name; });
  if (now == found.estimates.end() || then == earlier.numbers.end()) return "";
  const ParameterUnit unit = unit_of(*now);
  const double change = now->value - then->value;
  return fmt::format("{}{} {}", change > 0.0 ? "+" : "", unit.text(change), unit.name);
}

std::string difference(const Likeness& like) {
  return fmt::format("{} mm and {:.3f} mrad", mm(like.spread_m), like.spread_rad * 1e3);
}

}  // namespace

Json likeness_json(const Cell& cell, const Calibration& found) {
  if (!found.likeness || !cell.fit.earlier) return nullptr;
  const Likeness& like = *found.likeness;
  Json out{{"run", display_name(cell.fit.earlier->run)},
           {"numbers", like.numbers},
           {"alike", name_of(like.kind)}};
  put(out, "same_chance", like.same_chance);
  put(out, "share_pct", like.share * 100.0);
  put(out, "spread_mm", to_mm(like.spread_m));
  put(out, "spread_mrad", like.spread_rad * 1e3);
  if (like.changed.empty())
    put_null(out, "changed", "no single number differs");
  else
    out["changed"] = like.changed;
  put(out, "decided_by_readings", found.decided);
  return out;
}

std::string likeness_text(const Cell& cell, const Calibration& found) {
  if (!found.likeness || !cell.fit.earlier) return "";
  const Likeness& like = *found.likeness;
  const std::string run = display_name(cell.fit.earlier->run);
  std::string out;
  switch (like.kind) {
    case Likeness::Kind::kSame:
      out = like.changed.empty()
                ? fmt::format("The numbers of {} hold for this arm too, give or take {}.", run,
                              difference(like))
                : fmt::format(
                      "The numbers of {} hold for this arm too, but for {}, which differs "
                      "by {}.",
                      run, like.changed, change_words(*cell.fit.earlier, found, like.changed));
      break;
    case Likeness::Kind::kSister:
      out = fmt::format("This arm is like that of {}: their numbers differ by {} (1 sigma).", run,
                        difference(like));
      break;
    case Likeness::Kind::kUnlike:
      out = fmt::format("This arm is unlike that of {}: next to nothing is taken over.", run);
      break;
    case Likeness::Kind::kUnknown:
      out = fmt::format(
          "These readings cannot tell how much the arm of {} has in common with this "
          "one; taken over give or take {}.",
          run, difference(like));
  }
  return out + fmt::format(
                   "\n  {} numbers of the arm are known from there; the readings decide "
                   "as much as {:.0f} of all {} numbers\n",
                   like.numbers, found.decided, found.estimates.size());
}

}  // namespace plumb::offline::show
