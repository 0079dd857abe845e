// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "report/html.hpp"
#include "report/report_data.hpp"

namespace plumb::offline::report {

inline constexpr double kWide_px = 760.0, kNarrow_px = 368.0;  // widths of every figure

/// The page of the report on which a figure stands.
enum class Page {
  kVerdict,
  kData,
  kWhere,
  kPatterns,
  kMissing,
  kAdded,
  kParameters,
  kController,
  kLimits
};

/// Where the figure of that name belongs: by the longest beginning of it that is known; else where
/// the model fails.
Page page_of(const std::string& figure);

/// The figures of a report, each laid out for a wide page and for a narrow one.
class ReportFigures {
 public:
  /// Draws all that this cell has and that show something. Of the figures of single joints only
  /// those of joints whose own position explains something of the error, at most two; the small
  /// ones show them all.
  explicit ReportFigures(const ReportData& data);

  /// Appends those of a page, in the order of the registry, and one line that names those which
  /// would show nothing.
  void put(Page page, Html& html) const;

 private:
  struct Drawn {
    std::string name, wide, narrow;
  };
  struct LeftOut {
    std::string name, why;
  };
  std::vector<Drawn> all_;
  std::vector<LeftOut> left_out_;
};

}  // namespace plumb::offline::report
