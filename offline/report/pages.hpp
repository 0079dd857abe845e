// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/html.hpp"
#include "report/report_data.hpp"
#include "report/report_figures.hpp"

/// The pages of a report, one function each, in their order. Every sentence is computed from the
/// data.
namespace plumb::offline::report {

Html verdict_page(const ReportData& data, const ReportFigures& figures);
Html data_page(const ReportData& data, const ReportFigures& figures);
Html where_page(const ReportData& data, const ReportFigures& figures);
Html patterns_page(const ReportData& data, const ReportFigures& figures);
Html missing_page(const ReportData& data, const ReportFigures& figures);
Html added_page(const ReportData& data, const ReportFigures& figures);
Html parameters_page(const ReportData& data, const ReportFigures& figures);
Html controller_page(const ReportData& data, const ReportFigures& figures);
Html limits_page(const ReportData& data, const ReportFigures& figures);
Html reproduce_page(const ReportData& data);

/// The terms of `plumb explain` that occur in the pages before it.
Html glossary_page(const ReportData& data, const std::string& pages);

}  // namespace plumb::offline::report
