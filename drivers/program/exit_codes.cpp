// SPDX-License-Identifier: Apache-2.0
#include "program/exit_codes.hpp"

namespace plumb {

const std::vector<ExitRow>& exit_codes() {
  static const std::vector<ExitRow> rows{
      {Exit::kDone, "done"},
      {Exit::kGateFailed, "the gate that you asked for failed"},
      {Exit::kUsage, "the command line is wrong"},
      {Exit::kInput, "an input file or its data are wrong"},
      {Exit::kNumbersSayNo, "the numbers say no"},
      {Exit::kEnvironment, "the environment does not let us"},
      {Exit::kBusLost, "the bus was lost", ExitRow::Of::kBusPrograms},
      {Exit::kBug, "a bug"},
      {Exit::kInterrupted, "interrupted"}};
  return rows;
}

}  // namespace plumb
