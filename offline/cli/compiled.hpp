// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli/cell_data.hpp"
#include "compile/audit.hpp"
#include "plumb/format/model.hpp"
#include "program/output_files.hpp"

namespace plumb::offline::cli {

/// --refit-all and --gate of the verbs that compile.
struct CompileOptions {
  bool refit_all = false;
  bool gate = false;
  void add_to(VerbOptions& verb);
};

/// A model, and the run behind it.
struct Compiled {
  format::Model model;
  int run = 0;  // 0: it was not kept
  bool refit_all = false;
  int folds = 0;              // of the held-out figure; 0: one held-out set, or none
  ErrorStats held;            // that the verdict rests on; the model carries that of all readings
  std::string without;        // what it leaves out, in words
  bool size_unknown = false;  // of the arm: the error is that of its shape

  /// Adds `run`, or null with its reason, and `refit_all`.
  void put_run(Json& result) const;
};

/// The model of the cell's current run, or of a new one that is kept unless nothing is to be
/// written. With refit_all its numbers come from every pose; the run stays the evidence behind
/// them.
Compiled compiled(Cell& cell, const CompileOptions& options, const WriteOptions& write,
                  Outcome& outcome);

/// What --gate requires: no warning of the audit, and held-out poses that keep the tolerance
/// of an arm whose size was measured.
/// What fails becomes an error of `outcome`, exit kGateFailed.
void check_gate(const Audit& audit, const Compiled& made, double tolerance_m, Outcome& outcome);

/// "Compiled Line for Arm (serial 1): held-out mean 0.02 mm, 95 % 0.04 mm." With folds, a sentence
/// more: which models that error is of.
std::string compiled_headline(const Compiled& made, double tolerance_m);

}  // namespace plumb::offline::cli
