// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/blind/marks.hpp"

namespace plumb::tests {

using Which = std::function<bool(const Score&)>;

/// Whether what was added made the error at new poses larger than that of geometry alone.
bool is_worse(const Score& s);

/// Of at least one number; the upper of the two in the middle.
double median_of(std::vector<double> numbers);

/// Marks of a study, added one by one: shares and medians of the cases that `of` picks. A mark to
/// which no case belongs is left out.
class MarkList {
 public:
  /// `granted`: see marks_of.
  MarkList(const std::vector<Score>& scores, double granted) : scores_(scores), granted_(granted) {}

  void at_least(const std::string& what, double share, const Which& of, const Which& holds);
  void at_most(const std::string& what, double share, const Which& of, const Which& holds);
  /// Left out where there are fewer than five cases.
  void median_at_most(const std::string& what, double limit, const Which& of,
                      const std::function<double(const Score&)>& value);
  std::vector<Mark> take() { return std::move(marks_); }

 private:
  void add_share(const std::string& what, double share, const Which& of, const Which& holds,
                 bool least);

  const std::vector<Score>& scores_;
  double granted_;
  std::vector<Mark> marks_;
};

}  // namespace plumb::tests
