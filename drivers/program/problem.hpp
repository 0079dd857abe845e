// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <exception>
#include <optional>
#include <string>
#include <vector>

namespace plumb {

/// error: nothing was written. warning: done, but read this. note: a choice made for you.
enum class Severity { kError, kWarning, kNote };

/// Process exit codes; the contract of every program.
enum class Exit : int {
  kDone = 0,
  kGateFailed = 1,
  kUsage = 2,
  kInput = 3,
  kNumbersSayNo = 4,
  kEnvironment = 5,
  kBusLost = 6,
  kBug = 70,
  kInterrupted = 130,
};

/// Where in a file; line and column count from 1, 0 = unknown.
struct Place {
  std::string file = {};
  int line = 0;
  int column = 0;
  int length = 1;           // characters under the caret
  std::string source = {};  // the text of the line
  std::string label = {};   // stands behind the caret: "add a unit suffix"
};

struct Problem {
  Severity severity = Severity::kError;
  std::string code = {};     // stable, for example "E-CSV-UNIT"
  std::string message = {};  // one sentence without a full stop
  std::optional<Place> place = std::nullopt;
  std::string help = {};  // one line that can be pasted
};

/// error[E-CSV-UNIT]: column 'x' has no unit
///   --> tracker.csv:1:20
///    |
///  1 | pose,q1_deg,q2_deg,x,y_mm
///    |                    ^ add a unit suffix
///    = help: rename it to 'x_mm', or: plumb import tracker.csv --map x=x_mm
std::string render(const Problem& problem);

/// Thrown when a verb cannot go on; carries every problem found in one pass (first 20 are shown).
class Failure : public std::exception {
 public:
  Failure(Exit exit, std::vector<Problem> problems);
  Failure(Exit exit, Problem problem);
  Exit exit_code() const noexcept { return exit_; }
  const std::vector<Problem>& problems() const noexcept { return problems_; }
  const char* what() const noexcept override { return what_.c_str(); }

 private:
  Exit exit_;
  std::vector<Problem> problems_;
  std::string what_;
};

/// Letters to insert, delete, replace or swap with their neighbour to make `b` of `a`.
int edit_distance(const std::string& a, const std::string& b);

/// The candidate nearest to `word`, if near enough for "did you mean".
std::optional<std::string> did_you_mean(const std::string& word,
                                        const std::vector<std::string>& candidates);

}  // namespace plumb
