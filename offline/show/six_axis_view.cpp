// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "show/study_view.hpp"
#include "show/table.hpp"
#include "show/units.hpp"

namespace plumb::offline::show {
namespace {

using study::SixAxisDraw;
using study::SixAxisStudy;

struct TableFigure {
  const char* key;
  const char* words;
  const char* paper;
  double SixAxisDraw::*value;
};

constexpr TableFigure kTableFigures[] = {
    {"before_mm", "seen poses, no correction", "0.057", &SixAxisDraw::before},
    {"published_seen_mm", "seen poses, three trees of five leaves", "0.0126",
     &SixAxisDraw::published_seen},
    {"noise_seen_mm", "the same trees on white noise of that size", "", &SixAxisDraw::noise_seen},
    {"before_fresh_mm", "fresh poses, no correction", "", &SixAxisDraw::before_fresh},
    {"published_fresh_mm", "fresh poses, three trees of five leaves", "",
     &SixAxisDraw::published_fresh},
    {"noise_fresh_mm", "fresh poses, what the trees of noise do", "", &SixAxisDraw::noise_fresh},
    {"ours_fresh_mm", "fresh poses, plumb diagnose --apply", "", &SixAxisDraw::ours_fresh}};

int worse(const SixAxisStudy& study, double SixAxisDraw::*figure) {
  return static_cast<int>(
      std::count_if(study.draws.begin(), study.draws.end(),
                    [&](const auto& draw) { return draw.*figure > draw.before_fresh; }));
}

}  // namespace

Json six_axis_json(const SixAxisStudy& study) {
  Json out{{"study", "six-axis"},
           {"draws", study.draws.size()},
           {"poses", study.request.poses},
           {"seed", study.request.seed}};
  for (const TableFigure& figure : kTableFigures) {
    out["median"][figure.key] = to_mm(median_of(study, figure.value));
    out["worst"][figure.key] = to_mm(worst_of(study, figure.value));
  }
  out["published_worse_than_nothing"] = worse(study, &SixAxisDraw::published_fresh);
  out["ours_worse_than_nothing"] = worse(study, &SixAxisDraw::ours_fresh);
  out["rows"] = Json::array();
  for (const auto& draw : study.draws) {
    Json row{{"added", draw.added}, {"tree", draw.tree}};
    for (const TableFigure& figure : kTableFigures) row[figure.key] = to_mm(draw.*figure.value);
    out["rows"].push_back(row);
  }
  return out;
}

std::string six_axis_text(const SixAxisStudy& study) {
  std::string out = fmt::format(
      "The published figure is no evidence: trees that take {:.3f} to {:.4f} mm on the poses they "
      "were trained with leave {:.3f} mm on fresh ones, worse than no correction for {} of {} "
      "arms; "
      "naming the physics leaves {:.4f} mm, worse for {}.\n\n",
      to_mm(median_of(study, &SixAxisDraw::before)),
      to_mm(median_of(study, &SixAxisDraw::published_seen)),
      to_mm(median_of(study, &SixAxisDraw::published_fresh)),
      worse(study, &SixAxisDraw::published_fresh), study.draws.size(),
      to_mm(median_of(study, &SixAxisDraw::ours_fresh)), worse(study, &SixAxisDraw::ours_fresh));
  Table table{.head = {fmt::format("mean position error [mm] of {} arms, {} poses each",
                                   study.draws.size(), study.request.poses),
                       "paper", "median", "worst"}};
  for (const TableFigure& figure : kTableFigures)
    table.add({figure.words, figure.paper,
               fmt::format("{:.4f}", to_mm(median_of(study, figure.value))),
               fmt::format("{:.4f}", to_mm(worst_of(study, figure.value)))});
  out += text_of(table) + "\n";
  std::map<std::string, int> added;
  for (const auto& draw : study.draws) ++added[draw.added];
  out += "What the diagnosis added, without having seen the truth:\n";
  for (const auto& [what, times] : added) out += fmt::format("  {:>3} x {}\n", times, what);
  return out + "\nTrees for these poses: " + study.draws.front().tree + "\n";
}

}  // namespace plumb::offline::show
