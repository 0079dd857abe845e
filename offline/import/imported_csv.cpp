// SPDX-License-Identifier: Apache-2.0
#include "import/imported_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "cell/column_names.hpp"
#include "cell/csv_line.hpp"
#include "cell/table_reader.hpp"

namespace plumb::offline {
namespace {

constexpr std::size_t kBlock = 1 << 20;  // [bytes]

int order_of(const std::string& name) {
  static const std::vector<std::string> kFirst{"pose", "repeat", "set"};
  if (const auto at = std::find(kFirst.begin(), kFirst.end(), name); at != kFirst.end())
    return static_cast<int>(at - kFirst.begin());
  if (const int j = joint_number(name, "q"); j > 0) return 10 + j;
  if (const int j = joint_number(name, "qc"); j > 0) return 30 + j;
  static const std::vector<std::string> kPointOrder{"x",  "y",  "z",  "qw", "qx", "qy", "qz",
                                                    "sx", "sy", "sz", "nx", "ny", "nz"};
  const auto at = std::find(kPointOrder.begin(), kPointOrder.end(), name);
  return at != kPointOrder.end() ? 50 + static_cast<int>(at - kPointOrder.begin()) : 100;
}

struct WrittenColumn {
  const ImportedColumn* column;
  bool text;  // may need quotes
};

std::vector<WrittenColumn> in_order(const std::vector<ImportedColumn>& columns) {
  std::vector<WrittenColumn> out;
  for (const auto& column : columns)
    out.push_back({&column, unitless_quantity(column.name) == Quantity::kText});
  std::stable_sort(out.begin(), out.end(), [](const WrittenColumn& a, const WrittenColumn& b) {
    return order_of(a.column->name) < order_of(b.column->name);
  });
  return out;
}

std::string head_of(const Imported& data, const std::vector<WrittenColumn>& columns) {
  std::string out;
  for (const auto& [key, value] : data.comments)
    if (key != "rot") out += fmt::format("# {}: {}\n", key, value);
  out += fmt::format("# imported from: {}\n", std::filesystem::path(data.file).filename().string());
  for (std::size_t k = 0; k < columns.size(); ++k)
    out += (k > 0 ? "," : "") + columns[k].column->heading();
  return out + '\n';
}

void append_row(const std::vector<WrittenColumn>& columns, std::size_t row, std::string& out) {
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (k > 0) out += ',';
    const std::string_view text = columns[k].column->text[row];
    if (columns[k].text)
      out += quoted_if_needed(std::string(text));
    else
      out += text;
  }
  out += '\n';
}

}  // namespace

void write_imported(const Imported& data, const std::function<void(std::string_view)>& write) {
  const auto columns = in_order(data.columns);
  std::string block = head_of(data, columns);
  for (std::size_t i = 0; i < data.lines.size(); ++i) {
    append_row(columns, i, block);
    if (block.size() < kBlock) continue;
    write(block);
    block.clear();
  }
  if (!block.empty()) write(block);
}

void check_imported(const Imported& data) {
  TableReader first("imported");
  std::optional<TableReader> header;
  int next_line = 1;
  write_imported(data, [&](std::string_view block) {
    const auto lines = static_cast<int>(std::count(block.begin(), block.end(), '\n'));
    TableReader reader = header ? header->below(next_line) : first;
    reader.expect(static_cast<std::size_t>(lines), block.size());
    reader.read(block);
    if (!header) reader.check_content();
    reader.problems().stop_on_errors();
    if (!header) header = reader.below(1);
    next_line += lines;
  });
}

}  // namespace plumb::offline
