// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "program/program.hpp"

/// One function a verb: adds it with its options to the program.
namespace plumb::offline::cli {

void add_demo(Program& program);
void add_new(Program& program);
void add_import(Program& program);
void add_check(Program& program);
void add_fit(Program& program);
void add_compare(Program& program);
void add_diagnose(Program& program);
void add_add(Program& program);
void add_drop(Program& program);
void add_plan(Program& program);
void add_recheck(Program& program);
void add_fleet(Program& program);
void add_runs(Program& program);
void add_diff(Program& program);
void add_compile(Program& program);
void add_export(Program& program);
void add_keygen(Program& program);
void add_deploy(Program& program);
void add_dbc(Program& program);
void add_modbus_map(Program& program);
void add_inspect(Program& program);
void add_predict(Program& program);
void add_correct(Program& program);
void add_filter(Program& program);
void add_bench(Program& program);
void add_simulate(Program& program);
void add_study(Program& program);
void add_plot(Program& program);
void add_report(Program& program);
void add_serve(Program& program);
void add_explain(Program& program);

}  // namespace plumb::offline::cli
