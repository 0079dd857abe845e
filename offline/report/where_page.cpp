// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "figures/worst_band.hpp"
#include "report/pages.hpp"
#include "show/compare_words.hpp"
#include "show/units.hpp"

namespace plumb::offline::report {
namespace {

constexpr std::size_t kWorstListed = 10;

HtmlTable worst_table(const ReportData& data) {
  const bool held = data.comparison.set == compare::Comparison::Set::kHeldOut;
  HtmlTable table{
      .caption = fmt::format("Worst {} readings, measured - predicted in the measurement "
                             "frame [mm], and where the joints were",
                             held ? "held-out" : "fitted"),
      .head = {"pose", "error", "dx", "dy", "dz"}};
  for (const auto& row : data.cell.nominal.joints)
    table.head.push_back(fmt::format("{} [{}]", row.name, show::unit(show::slides(row))));
  const auto& poses = data.comparison.poses;
  for (std::size_t i = 0; i < std::min(kWorstListed, poses.size()); ++i) {
    const auto& pose = poses[i];
    std::vector<std::string> row{pose.pose, show::mm(pose.error_M.norm())};
    for (int k = 0; k < 3; ++k) row.push_back(fmt::format("{:+.3f}", show::to_mm(pose.error_M(k))));
    for (int j = 0; j < data.cell.joints(); ++j)
      row.push_back(fmt::format(
          "{:.1f}",
          show::shown(data.measured.q(pose.row, j),
                      show::slides(data.cell.nominal.joints[static_cast<std::size_t>(j)]))));
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

Html where_page(const ReportData& data, const ReportFigures& figures) {
  Html html;
  html.paragraph(figures::where_sentence(data.results));
  const auto& profiles = data.comparison.profiles;
  if (std::any_of(profiles.begin(), profiles.end(), [](const auto& p) { return p.matters; }))
    html.paragraph(show::where_words(data.comparison));
  figures.put(Page::kWhere, html);
  html.table(worst_table(data));
  return html;
}

}  // namespace plumb::offline::report
