// SPDX-License-Identifier: Apache-2.0
#include "cli/csv_output.hpp"

#include <fmt/format.h>

#include "program/file.hpp"

namespace plumb::offline::cli {
void CsvOutput::add_to(VerbOptions& verb) {
  verb.add_option("-o,--output", file, "CSV file to write; else stdout").type_name("FILE");
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

void refuse_existing(const CsvOutput& output, const Outcome& outcome) {
  if (output.file.empty()) return;
  OutputFiles files;
  files.add(output.file, "");
  files.check(output.write, outcome);
}

std::vector<Problem> replaced_notes(const std::vector<std::string>& columns) {
  std::vector<Problem> out;
  for (const auto& name : columns)
    out.push_back({.severity = Severity::kNote,
                   .code = "N-CSV-REPLACED",
                   .message = fmt::format("column '{}' of the input was replaced", name)});
  return out;
}

void deliver(const show::CsvColumns& columns, const CsvOutput& output, const std::string& summary,
             Outcome& outcome) {
  outcome.remark(replaced_notes(columns.replaced()));
  if (output.file.empty()) {
    outcome.text = columns.text();
    return;
  }
  OutputFiles files;
  files.add(output.file, columns.text());
  files.commit(output.write, outcome);
  outcome.text = summary + wrote(output.file, output.write) + "\n";
}

void deliver(Spool& spool, const CsvOutput& output, Outcome& outcome) {
  const bool named = !output.file.empty();
  if (named) {
    outcome.result["files"] = Json::array({output.file});
    outcome.result["dry_run"] = output.write.dry_run;
  }
  const auto note = named ? folder_note(output.file, output.write) : std::nullopt;
  if (!output.write.dry_run) spool.commit(output.write.force ? Overwrite::kForce : Overwrite::kNo);
  if (note) outcome.remark({*note});
}

void StatusCounts::add(Status status, std::size_t rows) {
  const int number = static_cast<int>(status);
  auto& entry = counts_[refused(status) ? 100 - number : number];
  entry.first = status;
  entry.second += rows;
}

void StatusCounts::add(const StatusCounts& more) {
  for (const auto& [order, entry] : more.counts_) add(entry.first, entry.second);
}

std::size_t StatusCounts::rows() const {
  std::size_t sum = 0;
  for (const auto& [order, entry] : counts_) sum += entry.second;
  return sum;
}

std::size_t StatusCounts::refused_rows() const {
  std::size_t sum = 0;
  for (const auto& [order, entry] : counts_)
    if (refused(entry.first)) sum += entry.second;
  return sum;
}

std::size_t StatusCounts::of(Status status) const {
  std::size_t sum = 0;
  for (const auto& [order, entry] : counts_)
    if (entry.first == status) sum += entry.second;
  return sum;
}

Json to_json(const StatusCounts& counts) {
  Json out = Json::object();
  for (const auto& [order, entry] : counts.all()) out[to_string(entry.first)] = entry.second;
  return out;
}

std::string status_summary(const StatusCounts& counts) {
  std::string out;
  for (const auto& [order, entry] : counts.all())
    out += fmt::format("  {:<20} {:>6}\n", to_string(entry.first), entry.second);
  return out;
}

}  // namespace plumb::offline::cli
