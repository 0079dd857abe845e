// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "compare/worst_band.hpp"
#include "draw/panel.hpp"
#include "draw/sheet.hpp"
#include "draw/text_width.hpp"
#include "figures/error_axis.hpp"
#include "figures/error_figures.hpp"
#include "figures/words.hpp"

namespace plumb::offline::figures {
namespace {

using draw::Mark;
using draw::Tone;

constexpr std::size_t kMostPoses = 1200, kNamedPoses = 3;
constexpr double kEdge_px = 5.0;  // of a mark at the end of the axis

}  // namespace

std::string error_by_pose(const RunResults& results, double width) {
  std::vector<int> rows = results.judged();
  const bool held = !results.held.empty();
  const auto fill = held ? Mark::Fill::kFilled : Mark::Fill::kHollow;
  const Mark before{draw::Shape::kSquare, Tone::kVermilion, fill, 3.0};
  const Mark after{draw::Shape::kCircle, Tone::kBlue, fill, 3.2};
  auto notes = error_notes(results);
  rows = thinned(results, rows, kMostPoses);
  if (const auto note = thinning_note(rows.size(), results.judged().size()); !note.empty())
    notes.push_back(note);
  std::stable_sort(rows.begin(), rows.end(),
                   [&](int a, int b) { return results.after(a) < results.after(b); });
  const std::string kind = held ? ", held out" : ", fitted";
  const ErrorAxis axis = error_axis(results);
  draw::SheetText text{
      .title = "Error of every pose, sorted",
      .sentence = compare::where_sentence(results.cell, results.measured, results.run.fit),
      .legend = {{.words = "before" + kind, .mark = before},
                 {.words = "after" + kind, .mark = after}},
      .notes = std::move(notes)};
  add_beyond(results, axis, rows, text);
  draw::Sheet sheet(width, std::move(text));
  draw::Panel panel(sheet.svg(), sheet.room(380.0),
                    {.title = "poses in the order of their error after calibration",
                     .low = 0.0,
                     .high = static_cast<double>(std::max<std::size_t>(1, rows.size()))},
                    axis.axis);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double x = static_cast<double>(i) + 0.5;
    const auto draw_one = [&](Mark one, double error_m) {
      one.pose = results.pose(rows[i]);
      if (axis.ends_before(error_m)) one.shape = draw::Shape::kTriangle, one.size = kEdge_px;
      panel.mark(x, axis.of(error_m), one);
    };
    draw_one(before, results.before(rows[i]));
    Mark told = after;
    told.words = pose_numbers(results, rows[i]);
    draw_one(told, results.after(rows[i]));
  }
  draw_limits(results, axis, Along::kY, panel);
  for (std::size_t k = 0; k < std::min(kNamedPoses, rows.size()); ++k) {
    const std::size_t i = rows.size() - 1 - k;
    panel.label(static_cast<double>(i) + 0.5, axis.of(results.after(rows[i])),
                draw::shortened(results.pose(rows[i]), 11.0, 120.0));
  }
  return sheet.file();
}

}  // namespace plumb::offline::figures
