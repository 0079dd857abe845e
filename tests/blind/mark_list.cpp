// SPDX-License-Identifier: Apache-2.0
#include "tests/blind/mark_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plumb::tests {
namespace {

constexpr std::size_t kFewestForAMedian = 5;

}  // namespace

bool is_worse(const Score& s) { return s.after > 1.02 * s.before + 0.02; }

double median_of(std::vector<double> numbers) {
  const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  std::nth_element(numbers.begin(), middle, numbers.end());
  return *middle;
}

void MarkList::at_least(const std::string& what, double share, const Which& of,
                        const Which& holds) {
  add_share(what, share, of, holds, true);
}

void MarkList::at_most(const std::string& what, double share, const Which& of, const Which& holds) {
  add_share(what, share, of, holds, false);
}

void MarkList::median_at_most(const std::string& what, double limit, const Which& of,
                              const std::function<double(const Score&)>& value) {
  std::vector<double> all;
  for (const auto& s : scores_)
    if (s.made && of(s)) all.push_back(value(s));
  if (all.size() < kFewestForAMedian) return;
  const double median = median_of(all);
  // The median of few is uncertain by about 1.25 sigma / sqrt(n); half the limit stands for sigma.
  const double granted = 0.3 * granted_ * limit / std::sqrt(static_cast<double>(all.size()));
  marks_.push_back({what, fmt::format("{:.2f} of {}", median, all.size()),
                    fmt::format("median <= {:.2f}", limit), median <= limit,
                    median <= limit + granted});
}

void MarkList::add_share(const std::string& what, double share, const Which& of, const Which& holds,
                         bool least) {
  int n = 0, k = 0;
  for (const auto& s : scores_)
    if (s.made && of(s)) ++n, k += holds(s);
  if (n == 0) return;
  const double got = static_cast<double>(k) / n;
  const double granted = granted_ * std::sqrt(share * (1.0 - share) / n);
  const double short_by = (least ? share - got : got - share) - 1e-9;
  marks_.push_back({what, fmt::format("{:.1f} % of {}", 100.0 * got, n),
                    fmt::format("{} {:.1f} %", least ? ">=" : "<=", 100.0 * share), short_by <= 0.0,
                    short_by <= granted});
}

}  // namespace plumb::tests
