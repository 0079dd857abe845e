// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "import/column_plan.hpp"
#include "import/content.hpp"
#include "import/raw_rows.hpp"
#include "program/problem.hpp"

namespace plumb::offline {

/// What is asked where columns do not say a unit that plumb knows: E-IMPORT-UNIT, in a preview the
/// warning W-IMPORT-UNIT.
class UnitQuestions {
 public:
  UnitQuestions(const SourceText& text, const Dialect& dialect,
                const std::vector<ColumnContent>& contents, bool preview)
      : text_(text), dialect_(dialect), contents_(contents), preview_(preview) {}

  /// One sentence and one line to paste for all columns that do not say their unit.
  Problem without_unit(const std::vector<ColumnPlan>& plans,
                       const std::vector<std::size_t>& unitless) const;

  /// Of a column in a unit that plumb does not convert.
  Problem of_another_unit(const ColumnPlan& plan) const;

 private:
  UnitChoice choice_for(const std::vector<ColumnPlan>& plans, std::size_t k) const;
  Problem of_unit(const ColumnPlan& plan, std::string message, std::string label,
                  std::string help) const;

  const SourceText& text_;
  const Dialect& dialect_;
  const std::vector<ColumnContent>& contents_;
  bool preview_;
};

}  // namespace plumb::offline
