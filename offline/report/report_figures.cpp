// SPDX-License-Identifier: Apache-2.0
#include "report/report_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <future>
#include <string_view>
#include <thread>
#include <utility>

#include "figures/evidence_figure.hpp"
#include "figures/registry.hpp"

namespace plumb::offline::report {
namespace {

constexpr std::size_t kMostJoints = 2;  // drawn large
constexpr unsigned kMostThreads = 4;

struct FigurePage {
  std::string_view begins;
  Page page;
};

constexpr std::array kFigurePages{
    FigurePage{"error-hist", Page::kVerdict},     FigurePage{"error-", Page::kWhere},
    FigurePage{"regions", Page::kWhere},          FigurePage{"orientations", Page::kWhere},
    FigurePage{"joint", Page::kPatterns},         FigurePage{"spectrum", Page::kPatterns},
    FigurePage{"load", Page::kPatterns},          FigurePage{"context", Page::kPatterns},
    FigurePage{"order", Page::kPatterns},         FigurePage{"coverage", Page::kData},
    FigurePage{"evidence", Page::kMissing},       FigurePage{"observability", Page::kMissing},
    FigurePage{"waterfall", Page::kAdded},        FigurePage{"leaf-map", Page::kAdded},
    FigurePage{"formulas", Page::kAdded},         FigurePage{"parameters", Page::kParameters},
    FigurePage{"correlation", Page::kParameters}, FigurePage{"history", Page::kVerdict},
    FigurePage{"cost", Page::kController},        FigurePage{"latency", Page::kController},
    FigurePage{"uncertainty", Page::kLimits},     FigurePage{"refusals", Page::kLimits}};

/// Joints whose own position explains something of the error, the one that explains most first.
std::vector<std::string> joints_that_matter(const ReportData& data) {
  std::vector<compare::JointShare> shares;
  for (const auto& share : data.comparison.joints)
    if (share.matters) shares.push_back(share);
  std::stable_sort(shares.begin(), shares.end(),
                   [](const auto& a, const auto& b) { return a.share > b.share; });
  std::vector<std::string> out;
  for (const auto& share : shares)
    if (out.size() < kMostJoints)
      out.push_back(data.cell.nominal.joints[static_cast<std::size_t>(share.joint)].name);
  return out;
}

/// Figures of one joint end with its name: "joint-J2", "spectrum-J2".
bool is_of_unimportant_joint(const std::string& name, const ReportData& data,
                             const std::vector<std::string>& important) {
  for (const auto& row : data.cell.nominal.joints) {
    if (std::find(important.begin(), important.end(), row.name) != important.end()) continue;
    for (const std::string of : {"joint-", "spectrum-", "load-"})
      if (name == of + row.name) return true;
  }
  return false;
}

/// Time stands in the figure of the order of measuring already.
constexpr const char* kShownElsewhere = "context-time";

std::string figure_of(const std::string& name, const ReportData& data, double width) {
  if (figures::needs_of(name) == figures::FigureRow::Needs::kDiagnosis)
    return data.diagnosis ? figures::evidence(data.cell, *data.diagnosis, width) : std::string();
  return figures::drawn(name, data.results, width, data.earlier).value_or("");
}

}  // namespace

Page page_of(const std::string& figure) {
  const FigurePage* best = nullptr;
  for (const FigurePage& entry : kFigurePages)
    if (figure.starts_with(entry.begins) &&
        (best == nullptr || entry.begins.size() > best->begins.size()))
      best = &entry;
  return best == nullptr ? Page::kWhere : best->page;
}

ReportFigures::ReportFigures(const ReportData& data) {
  const auto important = joints_that_matter(data);
  for (const auto& name : figures::figure_names(data.cell)) {
    if (name == kShownElsewhere || is_of_unimportant_joint(name, data, important)) continue;
    if (auto why = figures::why_empty(name, data.results); why.empty())
      all_.push_back({.name = name, .wide = {}, .narrow = {}});
    else
      left_out_.push_back({.name = name, .why = std::move(why)});
  }
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < all_.size(); i = next++) {
      all_[i].wide = figure_of(all_[i].name, data, kWide_px);
      all_[i].narrow = figure_of(all_[i].name, data, kNarrow_px);
    }
  };
  std::vector<std::future<void>> helpers;
  for (unsigned i = 1; i < std::min(kMostThreads, std::thread::hardware_concurrency()); ++i)
    helpers.push_back(std::async(std::launch::async, work));
  work();
  for (auto& helper : helpers) helper.get();  // throws what it threw
}

void ReportFigures::put(Page page, Html& html) const {
  for (const Drawn& one : all_)
    if (page_of(one.name) == page && !one.wide.empty()) html.figure(one.wide, one.narrow);
  std::string words;
  for (const LeftOut& one : left_out_)
    if (page_of(one.name) == page)
      words += fmt::format("{}{} ({})", words.empty() ? "Figures with nothing to show: " : ", ",
                           one.name, one.why);
  html.paragraph(words.empty() ? words : words + ".");
}

}  // namespace plumb::offline::report
