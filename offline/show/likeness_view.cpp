// SPDX-License-Identifier: Apache-2.0
#include "show/likeness_view.hpp"

#include <fmt/format.h>

#include "program/file.hpp"
#include "show/units.hpp"

namespace plumb::offline::show {
namespace {

std::string difference(const Likeness& like) {
  return fmt::format("{} mm and {:.3f} mrad", mm(like.spread_m), like.spread_rad * 1e3);
}

}  // namespace

void add_likeness(const Calibration& found, Json& result) {
  if (!found.likeness)
    return put_null(result, "from", "nothing was taken over from an earlier run");
  const Likeness& like = *found.likeness;
  result["from"] = {{"run", display_name(like.run)},        {"numbers", like.numbers},
                    {"alike", name_of(like.kind)},          {"same_chance", like.same_chance},
                    {"share_pct", like.share * 100.0},      {"spread_mm", to_mm(like.spread_m)},
                    {"spread_mrad", like.spread_rad * 1e3}, {"changed", like.changed},
                    {"decided_by_readings", found.decided}};
}

Blocks likeness_notes(const Calibration& found) {
  if (!found.likeness) return {};
  const Likeness& like = *found.likeness;
  const std::string run = display_name(like.run);
  std::string out;
  const std::string what = like.changed == "offsets" ? "the offsets of several joints"
                                                     : like.changed + ", or a link beside it,";
  switch (like.kind) {
    case Likeness::Kind::kSame:
      out = like.changed.empty()
                ? fmt::format("The numbers of {} hold for this arm too, give or take {}.", run,
                              difference(like))
                : fmt::format(
                      "The numbers of {} hold for this arm too, but it is as if {} had "
                      "changed; an effect that this cell does not list may look so as well.",
                      run, what);
      break;
    case Likeness::Kind::kSister:
      out = fmt::format("This arm is like that of {}: their numbers differ by {} (1 sigma).", run,
                        difference(like));
      break;
    case Likeness::Kind::kUnlike:
      out = fmt::format(
          "This arm has little in common with that of {}: measure at least 30 poses "
          "and fit it alone.",
          run);
      break;
    case Likeness::Kind::kUnknown:
      out = fmt::format(
          "These readings cannot tell how much the arm of {} has in common with this "
          "one; taken over give or take {}.",
          run, difference(like));
  }
  return {Note{std::move(out)},
          under(fmt::format("frame and target included, the readings decide {:.0f} of the {} "
                            "numbers, and the earlier run the others",
                            found.decided, found.estimates.size()))};
}

}  // namespace plumb::offline::show
