// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <utility>

namespace plumb::offline::programs {

/// The tool or frame that statements in the text have set so far. Where it is set inside a loop or
/// a condition, the order of the text is not that of the motion: then it is known only if all
/// statements say the same. The text is walked twice, with decide() between.
class CurrentFrame {
 public:
  /// `unset`: the name before any statement, and at the beginning of a routine.
  explicit CurrentFrame(std::string unset) : unset_(unset), name_(std::move(unset)) {}

  void set(const std::string& name, bool inside_block) {
    said_.insert(name);
    (inside_block ? in_block_ : outside_) = true;
    name_ = name;
  }

  void begin() { name_ = unset_; }

  void decide() {
    if (in_block_)
      only_ = outside_ && said_.size() == 1 ? *said_.begin() : "(set in a loop or a condition)";
    name_ = unset_;
  }

  std::string name() const { return only_.empty() ? name_ : only_; }

 private:
  std::string unset_, name_, only_;
  std::set<std::string> said_;
  bool in_block_ = false, outside_ = false;
};

}  // namespace plumb::offline::programs
