// SPDX-License-Identifier: Apache-2.0
#include "compare/pose_words.hpp"

#include <algorithm>
#include <cmath>

#include "draw/text_width.hpp"
#include "draw/ticks.hpp"
#include "fit/verdict.hpp"
#include "program/counted_words.hpp"

namespace plumb::offline::compare {
namespace {

constexpr double kMicrometresBelow_m = 0.01e-3;      // smaller lengths are shown in um
constexpr double kNamed_px = 160.0, kLetter = 12.0;  // a longer name of a pose is cut

/// Different names, in the order of the rows.
std::vector<std::string> names_of(const Measurements& measured, std::span<const int> rows,
                                  std::size_t most) {
  std::vector<std::string> out;
  for (const int row : rows) {
    const std::string name =
        draw::shortened(measured.pose[static_cast<std::size_t>(row)], kLetter, kNamed_px);
    if (std::find(out.begin(), out.end(), name) == out.end()) out.push_back(name);
    if (out.size() == most) break;
  }
  return out;
}

}  // namespace

std::vector<int> usual_rows(const Fit& fit, std::vector<int> rows) {
  const auto single = single_bad(fit);
  return without_outliers(without_outliers(std::move(rows), fit.calibration.outliers),
                          {single.begin(), single.end()});
}

std::vector<int> judged_rows(const Fit& fit) {
  std::vector<int> held = held_rows(fit.split);
  return usual_rows(fit, held.empty() ? fit_rows(fit.split) : std::move(held));
}

std::string judged_words(const Fit& fit) {
  const std::string kind = held_rows(fit.split).empty() ? "fitted" : "held-out";
  return counted_words(static_cast<long long>(judged_rows(fit).size()), kind + " pose",
                       kind + " poses") +
         without_words(fit);
}

std::string length_text(double metres) {
  if (std::abs(metres) < kMicrometresBelow_m) return draw::digits(metres * 1e6, 2) + " µm";
  return draw::digits(metres * 1e3, 2) + " mm";
}

std::string pose_names(const Measurements& measured, std::span<const int> rows, std::size_t most) {
  const auto names = names_of(measured, rows, most);
  std::string out;
  for (std::size_t i = 0; i < names.size(); ++i)
    out += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return out;
}

std::string pose_list(const Measurements& measured, std::span<const int> rows, std::size_t most) {
  const char* word = names_of(measured, rows, most).size() == 1 ? "pose " : "poses ";
  return word + pose_names(measured, rows, most);
}

}  // namespace plumb::offline::compare
