// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "report/report_data.hpp"

namespace plumb::offline::report {

struct Report {
  std::string html;  // one file: no script, and nothing that would be loaded
  int pages = 0;
  std::string verdict;       // one sentence
  std::optional<bool> good;  // nothing where no pose was held out
};

/// The report of a run. Cost: some 20 ms a figure at 1,500 poses, and there are about 20.
Report make_report(const ReportData& data);

/// Whether the calibration keeps its tolerance on held-out poses; nothing where none was held out.
std::optional<bool> is_good(const Run& run, double tolerance_m);

}  // namespace plumb::offline::report
