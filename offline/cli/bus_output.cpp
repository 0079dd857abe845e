// SPDX-License-Identifier: Apache-2.0
#include "cli/bus_output.hpp"

#include <fmt/format.h>

namespace plumb::offline::cli {

void BusOutput::add_to(VerbOptions& verb) {
  verb.add_option("-o,--output", file, "Where to write; else to stdout").type_name("FILE");
  write.add_to(verb);
}

std::string about(const Cell& cell) {
  return cell.serial.empty() ? cell.name : fmt::format("{} ({})", cell.name, cell.serial);
}

void put_out(const BusOutput& output, const std::string& key, const std::string& text,
             const std::string& headline, Outcome& outcome) {
  if (output.file.empty()) {
    outcome.result[key] = text;
    outcome.text = text;
    return;
  }
  OutputFiles files;
  files.add(output.file, text);
  files.commit(output.write, outcome);
  outcome.text = headline + "\n\n" + wrote(output.file, output.write) + "\n";
}

}  // namespace plumb::offline::cli
