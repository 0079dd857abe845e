// SPDX-License-Identifier: Apache-2.0
#include "fit/orientation_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace plumb::offline {
namespace {

using Kind = MeasuredOrientations::Kind;

std::string degrees(double rad) { return fmt::format("{:.2g} deg", rad * 180.0 / M_PI); }

Problem unstated(const MeasuredOrientations& judged) {
  Problem out{.severity = Severity::kNote,
              .code = "N-FIT-ORIENTATION",
              .message = "measured orientations are not used: their noise is not stated",
              .help = "to fit them too: [measurement] sigma_urad, 1 sigma of their noise"};
  if (judged.kind == Kind::kGood)
    out.help = fmt::format(
        "to fit them too: [measurement] sigma_urad = {}, by which they scatter "
        "about the fitted arm",
        sigma_urad_to_state(judged));
  return out;
}

}  // namespace

const char* name_of(Kind kind) {
  switch (kind) {
    case Kind::kNone:
      return "none";
    case Kind::kUnjudged:
      return "unjudged";
    case Kind::kGood:
      return "good";
    case Kind::kScattered:
      return "scattered";
    case Kind::kMissed:
      return "missed";
    case Kind::kOtherwise:
      return "otherwise";
    case Kind::kTurned:
      return "turned";
    case Kind::kConstant:
      return "constant";
    case Kind::kNominal:
      return "nominal";
    case Kind::kContradict:
      return "contradict";
    default:
      return "unexplained";
  }
}

std::string sigma_urad_to_state(const MeasuredOrientations& judged) {
  const double urad = std::max(1.0, judged.left_rad * 1e6);
  const double digit = std::pow(10.0, std::floor(std::log10(urad)) - 1.0);
  return fmt::format("{:.12g}", std::round(urad / digit) * digit);
}

std::string in_words(const MeasuredOrientations& judged, const std::vector<std::string>& meant) {
  switch (judged.kind) {
    case Kind::kScattered:
      return fmt::format(
          "the measured orientations scatter {:.2g} times sigma_urad, by {} urad per "
          "axis about the fitted arm",
          *judged.times, sigma_urad_to_state(judged));
    case Kind::kMissed:
      return fmt::format(
          "repeated orientations agree as sigma_urad says, but the fitted arm misses "
          "them by {} urad per axis, {:.2g} times as much: something turns the tool "
          "that the model lacks",
          sigma_urad_to_state(judged), *judged.times);
    case Kind::kOtherwise:
      return fmt::format("the measured orientations are meant otherwise: {}",
                         fmt::join(meant, ", or "));
    case Kind::kTurned:
      return fmt::format(
          "the measured orientations are those of another frame than the points: but "
          "for a constant turn they fit the arm to {}",
          degrees(judged.left_rad));
    case Kind::kConstant:
      return "the measured orientations are the same in all rows: none was measured";
    case Kind::kNominal:
      return fmt::format(
          "the measured orientations are those of the nominal arm, and not of the "
          "arm that the points show, from which they differ by {}: they were "
          "computed, not measured",
          degrees(judged.left_rad));
    case Kind::kContradict:
      return "the measured orientations contradict the points: an arm that fits both misses its "
             "points by more than one that fits the points alone";
    case Kind::kUnexplained:
      return fmt::format(
          "as labelled the measured orientations do not fit the arm that the points "
          "show: they are {} off",
          degrees(judged.labelled_rad));
    default:
      return "";
  }
}

std::string remedy(const MeasuredOrientations& judged) {
  switch (judged.kind) {
    case Kind::kScattered:
      return fmt::format(
          "state [measurement] sigma_urad = {}; but if the instrument is as good as "
          "stated, the model lacks what turns the tool: plumb diagnose",
          sigma_urad_to_state(judged));
    case Kind::kMissed:
      return "find what is missing: plumb diagnose";
    case Kind::kTurned:
      return "give points and orientations in one frame: that of the instrument";
    case Kind::kConstant:
    case Kind::kNominal:
      return "leave the orientation columns and sigma_urad out";
    case Kind::kContradict:
      return "are they of the same reading as the points? Else leave sigma_urad out";
    case Kind::kUnexplained:
      return "look for columns in another order or convention, or leave sigma_urad out";
    default:
      return "";
  }
}

std::optional<Problem> orientation_remark(const MeasuredOrientations& judged) {
  const std::string words = in_words(judged, {});
  if (judged.kind == Kind::kNone || judged.kind == Kind::kUnjudged || judged.kind == Kind::kGood)
    return judged.stated || judged.kind == Kind::kNone ? std::nullopt
                                                       : std::optional(unstated(judged));
  Problem out{.severity = Severity::kWarning,
              .code = "W-FIT-ORIENTATION",
              .message = words,
              .help = remedy(judged)};
  if (!judged.fit_to_use())
    out.message += judged.stated ? "; they were left out" : "; they are not used";
  else
    out.message += "; they were fitted with that weight";
  if (judged.kind == Kind::kUnexplained) out.help = "see how they may be meant: plumb check";
  return out;
}

}  // namespace plumb::offline
