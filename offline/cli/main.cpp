// SPDX-License-Identifier: Apache-2.0
#include "cli/verbs.hpp"

int main(int argc, char** argv) {
  using namespace plumb::offline::cli;
  plumb::Program program(
      {.name = "plumb",
       .about = "Calibrates a robot arm from measurements and compiles what it learnt for the "
                "controller.",
       .examples =
           "  plumb demo compliance mycell      # a sample cell with simulated measurements\n"
           "  plumb -C mycell fit               # calibrate it",
       .first = "plumb demo",
       .manual = {.files = {{"cell.toml",
                             "the arm, its measurements and its effects; a folder with "
                             "this file is a cell, in which the verbs work"},
                            {"measurements.csv", "what was measured"},
                            {"runs/", "one folder for every fit, never changed again"},
                            {"robot.plumb", "the model file that compile writes"}},
                  .see_also = {"plumb-rt", "plumb-twin"}}},
      plumb::WorksIn::kCell);
  for (const auto add :
       {add_demo,     add_new,   add_simulate,   add_import,  add_check,   add_fit,     add_compare,
        add_diagnose, add_add,   add_drop,       add_plan,    add_recheck, add_fleet,   add_runs,
        add_diff,     add_plot,  add_report,     add_serve,   add_compile, add_export,  add_keygen,
        add_deploy,   add_dbc,   add_modbus_map, add_inspect, add_predict, add_correct, add_filter,
        add_bench,    add_study, add_explain})
    add(program);
  return program.run(argc, argv);
}
