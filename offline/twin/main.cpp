// SPDX-License-Identifier: Apache-2.0
#include "twin/verbs.hpp"

int main(int argc, char** argv) {
  using namespace plumb::offline::twin;
  plumb::Program program(
      {.name = "plumb-twin",
       .about = "The other side of the bus for everyone without a robot: a controller that knows "
                "its nominal arm, a true arm that hides something, and a tracker.",
       .examples = "  plumb-twin new mytwin             # a cell, and what its arm hides\n"
                   "  plumb-twin run mytwin             # how far it misses without correction",
       .first = "plumb-twin new mytwin",
       .manual = {.files = {{"cell.toml", "what the maker of the arm says of it"},
                            {"twin.toml", "what the true arm hides, and the noise of the tracker"}},
                  .exits = plumb::ExitRow::Of::kBusPrograms,
                  .see_also = {"plumb", "plumb-rt"}}},
      plumb::WorksIn::kAnywhere);
  for (const auto add : {add_new, add_measure, add_run}) add(program);
  return program.run(argc, argv);
}
