// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "program/problem.hpp"

namespace plumb {

/// Errors and remarks of one pass over some files. Bounded, so that a hostile file cannot fill the
/// memory with messages.
class ProblemList {
 public:
  void add(Problem problem) {
    auto& list = problem.severity == Severity::kError ? errors_ : remarks_;
    if (list.size() < kMost) list.push_back(std::move(problem));
  }
  void error(std::string code, std::string message, Place place, std::string help) {
    add({Severity::kError, std::move(code), std::move(message), std::move(place), std::move(help)});
  }
  void warning(std::string code, std::string message, Place place, std::string help) {
    add({Severity::kWarning, std::move(code), std::move(message), std::move(place),
         std::move(help)});
  }
  void note(std::string code, std::string message, Place place, std::string help) {
    add({Severity::kNote, std::move(code), std::move(message), std::move(place), std::move(help)});
  }
  bool full() const { return errors_.size() >= kMost; }
  const std::vector<Problem>& errors() const { return errors_; }
  std::vector<Problem>& errors() { return errors_; }
  std::vector<Problem>& remarks() { return remarks_; }

  /// Throws Failure (kInput) if there is an error.
  void stop_on_errors() {
    if (!errors_.empty()) throw Failure(Exit::kInput, std::move(errors_));
  }

 private:
  static constexpr std::size_t kMost = 1000;  // problems kept; nobody reads more
  std::vector<Problem> errors_;
  std::vector<Problem> remarks_;
};

}  // namespace plumb
