// SPDX-License-Identifier: Apache-2.0
#include "plan/contrasts.hpp"

#include <algorithm>

namespace plumb::offline {
namespace {

struct Line {
  Contrast contrast;
  unsigned needs;  // an effect that needs any of these changes
  bool one_by_one;
  const char* name;
  const char* words;
  const char* first;
  const char* second;
};

/// The cheapest first.
constexpr Line kLines[] = {
    {Contrast::kLongerWait, kNeedsSteps, true, "longer_wait",
     "the same poses at once and after a longer wait", "measure as soon as the arm has arrived",
     "stay, wait 10 s longer, measure again"},
    {Contrast::kBothSides, kNeedsDirection | kNeedsTravel | kNeedsSteps, true, "both_sides",
     "the same poses from the + and from the - side",
     "arrive with every joint moving +: come from 10 deg below in all of them",
     "arrive with every joint moving -: come from 10 deg above in all of them"},
    {Contrast::kEndAgain, kNeedsTime | kNeedsOrder, false, "end_again",
     "the first poses again at the end", "first visit", "the same pose again at the end"},
    {Contrast::kTwoPayloads, kNeedsMasses | kNeedsPayload, false, "two_payloads",
     "the same poses without and with payload", "without payload",
     "with payload; enter its mass in payload_kg"},
    {Contrast::kColdAndWarm, kNeedsTemperature, false, "cold_and_warm",
     "the same poses cold and warm, at least 5 K apart", "cold, before any warming up",
     "warm, after the arm has run for an hour; record the temperature"},
    {Contrast::kPulled, kNeedsWrench, true, "pulled",
     "the same poses free and pulled at by a known force", "free",
     "pulled by a known force; enter it in fx_N, fy_N, fz_N"},
};

const Line* line_of(Contrast contrast) {
  for (const auto& line : kLines)
    if (line.contrast == contrast) return &line;
  return nullptr;
}

}  // namespace

std::vector<Contrast> contrasts_of(const EffectInfo& effect) {
  std::vector<Contrast> out;
  for (const auto& line : kLines)
    if ((effect.needs & line.needs) != 0) out.push_back(line.contrast);
  return out;
}

std::vector<Contrast> separating_contrasts(const EffectInfo& a, const EffectInfo& b) {
  std::vector<Contrast> out;
  for (const auto& line : kLines)
    if (((a.needs & line.needs) != 0) != ((b.needs & line.needs) != 0))
      out.push_back(line.contrast);
  return out;
}

std::string contrast_words(Contrast contrast) {
  const Line* line = line_of(contrast);
  return line == nullptr ? "poses alone" : line->words;
}

const char* contrast_name(Contrast contrast) {
  const Line* line = line_of(contrast);
  return line == nullptr ? "none" : line->name;
}

std::string instruction(Contrast contrast, bool second) {
  const Line* line = line_of(contrast);
  return line == nullptr ? "" : second ? line->second : line->first;
}

bool one_by_one(Contrast contrast) {
  const Line* line = line_of(contrast);
  return line != nullptr && line->one_by_one;
}

void apply_contrast(Contrast contrast, bool second, const ContrastSizes& sizes, ContextRows& rows) {
  switch (contrast) {
    case Contrast::kNone:
      break;
    case Contrast::kLongerWait:
      if (second) rows.step.setZero();
      break;
    case Contrast::kBothSides:
      rows.direction.setConstant(second ? -1.0 : 1.0);
      rows.step.setConstant(second ? -1.0 : 1.0);
      break;
    case Contrast::kEndAgain:
      if (!second) break;
      rows.time_s.array() += sizes.later_s;
      rows.order.array() += static_cast<double>(rows.order.size());
      break;
    case Contrast::kTwoPayloads:
      rows.payload.col(0).setConstant(second ? sizes.payload_kg : 0.0);
      break;
    case Contrast::kColdAndWarm:
      if (second) rows.temperature.array() += sizes.warmer_K;
      break;
    case Contrast::kPulled:
      rows.wrench.setZero();
      if (second) rows.wrench.leftCols<3>().setConstant(sizes.pull_N / 1.7320508075688772);
      break;
  }
}

}  // namespace plumb::offline
