// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "compare/worst_band.hpp"
#include "report/pages.hpp"
#include "show/compare_view.hpp"
#include "show/compare_words.hpp"
#include "show/units.hpp"

namespace plumb::offline::report {
namespace {

/// With the positions of the joints.
show::Table worst_table(const ReportData& data) {
  show::Table table = show::worst_table(data.comparison);
  table.caption += ", and where the joints were";
  const auto& joints = data.cell.nominal.joints;
  for (const auto& joint : joints)
    table.head.push_back(fmt::format("{} [{}]", joint.name, show::unit(show::slides(joint))));
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    for (std::size_t j = 0; j < joints.size(); ++j)
      table.rows[i].push_back(fmt::format(
          "{:.1f}",
          show::shown(data.measured.q(data.comparison.poses[i].row, static_cast<Eigen::Index>(j)),
                      show::slides(joints[j]))));
  return table;
}

}  // namespace

Html where_page(const ReportData& data, const ReportFigures& figures) {
  Html html;
  html.paragraph(compare::where_sentence(data.cell, data.measured, data.run.fit));
  const auto& profiles = data.comparison.profiles;
  if (std::any_of(profiles.begin(), profiles.end(), [](const auto& p) { return p.matters; }))
    html.paragraph(show::where_words(data.comparison));
  figures.put(Page::kWhere, html);
  html.table(worst_table(data));
  return html;
}

}  // namespace plumb::offline::report
