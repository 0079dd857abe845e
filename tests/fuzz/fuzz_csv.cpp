// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdint>
#include <string_view>

#include "cell/measurements.hpp"
#include "cell/table_file.hpp"
#include "import/dialect.hpp"
#include "tests/fuzz/refusals.hpp"

using namespace plumb::offline;
using plumb::tests::require;
using plumb::tests::require_helpful;

namespace {

/// Any bytes are a sound table or a helpful refusal.
void read_strictly(std::string_view text) {
  try {
    const Table table = parse_table(text, "fuzz.csv");
    for (const auto& column : table.columns) {
      const auto rows = static_cast<std::size_t>(table.rows());
      require(column.values.empty() || column.values.size() == rows, "columns are of one length");
      require(column.text.empty() || column.text.size() == rows, "columns are of one length");
      for (double v : column.values) require(std::isfinite(v), "numbers are finite");
    }
  } catch (const plumb::Failure& failure) {
    require_helpful(failure);
  }
}

/// And so with the reader that guesses.
void read_generously(std::string_view text) {
  try {
    SourceText source;
    decode(std::string(text), "fuzz.txt", source);
    const RawRows rows = cut(source, {});
    for (std::size_t i = 0; i < rows.cells.size(); ++i)
      require(rows.cells[i].size() == rows.dialect.header.size(), "rows are as long as the header");
  } catch (const plumb::Failure& failure) {
    require_helpful(failure);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  read_strictly(text);
  read_generously(text);
  return 0;
}
