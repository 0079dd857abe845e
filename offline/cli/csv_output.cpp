// SPDX-License-Identifier: Apache-2.0
#include "cli/csv_output.hpp"

#include <fmt/format.h>

#include <map>

namespace plumb::offline::cli {
namespace {

/// In the order of the numbers, so ok comes before what is wrong.
std::map<int, std::pair<std::string, int>> counted(const std::vector<Status>& status) {
  std::map<int, std::pair<std::string, int>> out;
  for (Status s : status) {
    auto& [name, count] = out[refused(s) ? 100 - static_cast<int>(s) : static_cast<int>(s)];
    name = to_string(s);
    ++count;
  }
  return out;
}

}  // namespace

void CsvOutput::add_to(CLI::App& verb) {
  verb.add_option("-o,--output", file, "CSV file to write; else stdout")->type_name("FILE");
  write.add_to(verb);
}

void check_output(const CsvOutput& output, const Globals& globals) {
  if (!output.file.empty()) return;
  const bool json = globals.output == Globals::Output::kJson;
  if (!json && !output.write.dry_run) return;
  throw Failure(Exit::kUsage, {.code = "E-USAGE",
                               .message = fmt::format("{} needs -o: stdout would hold the table",
                                                      json ? "--json" : "--dry-run"),
                               .help = "add -o out.csv"});
}

void deliver(const show::CsvColumns& columns, const CsvOutput& output, const std::string& summary,
             Outcome& outcome) {
  for (const auto& name : columns.replaced())
    outcome.remarks.push_back(
        {.severity = Severity::kNote,
         .code = "N-CSV-REPLACED",
         .message = fmt::format("column '{}' of the input was replaced", name)});
  if (output.file.empty()) {
    outcome.text = columns.text();
    return;
  }
  OutputFiles files;
  files.add(output.file, columns.text());
  files.commit(output.write, outcome);
  outcome.text = summary + wrote(output.file, output.write) + "\n";
}

std::vector<std::string> status_texts(const std::vector<Status>& status) {
  std::vector<std::string> out;
  out.reserve(status.size());
  for (Status s : status) out.emplace_back(to_string(s));
  return out;
}

Json status_counts(const std::vector<Status>& status) {
  Json out = Json::object();
  for (const auto& [order, entry] : counted(status)) out[entry.first] = entry.second;
  return out;
}

std::string status_summary(const std::vector<Status>& status) {
  std::string out;
  for (const auto& [order, entry] : counted(status))
    out += fmt::format("  {:<20} {:>6}\n", entry.first, entry.second);
  return out;
}

}  // namespace plumb::offline::cli
