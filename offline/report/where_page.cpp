// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "report/pages.hpp"
#include "show/compare_view.hpp"
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
  const auto put_figure = [&](const std::string&) { figures.put(Page::kWhere, html); };
  html.blocks(show::where_blocks(data.cell, data.comparison, data.answers), put_figure);
  html.table(worst_table(data));
  return html;
}

}  // namespace plumb::offline::report
