// SPDX-License-Identifier: Apache-2.0
#include "figures/words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "draw/ticks.hpp"
#include "effects/registry.hpp"
#include "fit/verdict.hpp"
#include "program/counted_words.hpp"

namespace plumb::offline::figures {
namespace {

constexpr double kMicrometresBelow_m = 0.2e-3;  // smaller lengths are shown in um
constexpr std::size_t kWorstShare = 10;

std::string counted_poses(std::size_t n, const std::string& kind) {
  return counted_words(static_cast<long long>(n), kind + " pose", kind + " poses");
}

std::string plain_name(const std::string& effect) {
  const EffectDescriptor* known = find_descriptor(effect);
  if (known != nullptr && known->law != nullptr) return known->law->title;
  std::string out = effect;
  std::replace(out.begin(), out.end(), '_', ' ');
  return out;
}

}  // namespace

LengthUnit unit_for(double largest_m) {
  return largest_m < kMicrometresBelow_m ? LengthUnit{"µm", 1e6} : LengthUnit{"mm", 1e3};
}

std::string effect_names(const std::vector<std::string>& effects, const std::string& between) {
  std::vector<std::string> names;
  for (auto at = effects.begin(); at != effects.end(); ++at) {
    if (std::find(effects.begin(), at, *at) != at) continue;
    const auto n = std::count(effects.begin(), effects.end(), *at);
    names.push_back(n > 1 ? fmt::format("{} ({} times)", plain_name(*at), n) : plain_name(*at));
  }
  return fmt::format("{}", fmt::join(names, between));
}

std::vector<std::string> error_notes(const RunResults& results) {
  std::vector<std::string> out;
  std::string who =
      fmt::format("Run {}: {}", results.run.number, counted_poses(results.held.size(), "held-out"));
  if (results.run.fit.split.folds > 0)
    who += fmt::format(", each predicted by a model that was fitted without it ({} folds).",
                       results.run.fit.split.folds);
  else
    who += ", " + counted_poses(results.fit.size(), "fitted") + ".";
  out.push_back("e = measured - predicted; error: its length. " + who);
  if (results.held.empty())
    out.emplace_back("No pose was held out: these errors are in-sample, and no accuracy.");
  return out;
}

std::vector<draw::LegendEntry> pose_legend(const RunResults& results) {
  std::vector<draw::LegendEntry> out;
  if (!results.held.empty()) out.push_back({.words = "held out", .mark = draw::Mark{}});
  if (!results.fit.empty())
    out.push_back({.words = "fitted", .mark = draw::Mark{.fill = draw::Mark::Fill::kHollow}});
  return out;
}

std::vector<double> sorted_errors(const RunResults& results, const std::vector<int>& rows,
                                  Which which) {
  std::vector<double> out;
  out.reserve(rows.size());
  for (const int row : rows)
    out.push_back(which == Which::kBefore ? results.before(row) : results.after(row));
  std::sort(out.begin(), out.end());
  return out;
}

double quantile_of(const std::vector<double>& ascending, double q) {
  if (ascending.empty()) return 0.0;
  const double at = std::ceil(q * static_cast<double>(ascending.size()) - 1e-9) - 1.0;
  return ascending[static_cast<std::size_t>(
      std::clamp(at, 0.0, static_cast<double>(ascending.size() - 1)))];
}

std::string pose_numbers(const RunResults& results, int row) {
  return fmt::format("{}: {} before, {} after", results.pose(row), length_text(results.before(row)),
                     length_text(results.after(row)));
}

std::vector<int> thinned(const RunResults& results, const std::vector<int>& rows,
                         std::size_t most) {
  if (rows.size() <= most) return rows;
  std::vector<int> worst = rows;
  const std::size_t named = most / kWorstShare;
  std::nth_element(worst.begin(), worst.begin() + static_cast<std::ptrdiff_t>(named), worst.end(),
                   [&](int a, int b) { return results.after(a) > results.after(b); });
  worst.resize(named);
  const double stride = static_cast<double>(rows.size()) / static_cast<double>(most - named);
  for (double at = 0.0; at < static_cast<double>(rows.size()); at += stride)
    worst.push_back(rows[static_cast<std::size_t>(at)]);
  std::sort(worst.begin(), worst.end());
  worst.erase(std::unique(worst.begin(), worst.end()), worst.end());
  return worst;
}

std::string thinning_note(std::size_t drawn, std::size_t all) {
  if (drawn >= all) return {};
  return fmt::format("{} of {} poses are drawn: the worst ones, and an even choice of the others.",
                     drawn, all);
}

}  // namespace plumb::offline::figures
