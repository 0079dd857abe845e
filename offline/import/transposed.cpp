// SPDX-License-Identifier: Apache-2.0
#include "import/transposed.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cell/column_names.hpp"
#include "import/column_guess.hpp"

namespace plumb::offline {
namespace {

constexpr std::size_t kMostQuantities = 100;
constexpr std::ptrdiff_t kFewestNames = 4;  // below one another: a transposed table

}  // namespace

void refuse_transposed(const SourceText& text, const RawRows& rows) {
  const auto known = [](std::string_view name) {
    const ColumnPlan plan = guess_column(std::string(name), "");
    return !plan.name.empty() && unitless_quantity(plan.name) != Quantity::kText;
  };
  if (rows.cells.size() > kMostQuantities) return;
  const auto& header = rows.dialect.header;
  const auto in_header = std::count_if(header.begin() + 1, header.end(), known);
  std::ptrdiff_t below = 0;
  for (std::size_t i = 0; i < rows.cells.size(); ++i) below += known(rows.cells[i].front()) ? 1 : 0;
  if (below < kFewestNames || below <= in_header ||
      2 * below < static_cast<std::ptrdiff_t>(rows.cells.size()))
    return;
  throw Failure(
      Exit::kInput,
      {.code = "E-IMPORT-TRANSPOSED",
       .message = fmt::format("the table is transposed: its rows are {}, {}, ..., and its "
                              "columns are the poses",
                              rows.cells[0].front(), rows.cells[1].front()),
       .place = Place{.file = text.file, .line = rows.lines.front()},
       .help = "write one row a pose: transpose the table in a spreadsheet (paste special) "
               "and export it again"});
}

}  // namespace plumb::offline
