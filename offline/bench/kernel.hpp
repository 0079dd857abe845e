// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <utility>

namespace plumb::offline::bench {

/// Whether the input of a call waits for the output of the one before.
enum class Chaining { kFree, kChained };

/// A part of the cycle that can be called again and again.
class Kernel {
 public:
  Kernel() = default;
  virtual ~Kernel() = default;
  Kernel(const Kernel&) = delete;
  Kernel& operator=(const Kernel&) = delete;

  /// Calls it at `count` inputs from the `first` on. The result depends on all calls, so
  /// that the compiler removes none of them.
  virtual double run(std::size_t first, std::size_t count, Chaining chaining) noexcept = 0;
};

/// call(i, link) evaluates input i plus 0 * link and returns a number of the output. In a
/// chain, `link` is the result of the call before, which therefore has to be waited for. The
/// compiler must not drop the product, because it would not be 0 if `link` were infinite or NaN.
template <class Call>
class KernelOf final : public Kernel {
 public:
  explicit KernelOf(Call call) : call_(std::move(call)) {}

  double run(std::size_t first, std::size_t count, Chaining chaining) noexcept override {
    return chaining == Chaining::kFree ? free(first, first + count) : chained(first, first + count);
  }

 private:
  double free(std::size_t i, std::size_t end) noexcept {
    double sum = 0.0;
    for (; i < end; ++i) sum += call_(i, 0.0);
    return sum;
  }
  double chained(std::size_t i, std::size_t end) noexcept {
    double link = 0.0;
    for (; i < end; ++i) link = call_(i, link);
    return link;
  }

  Call call_;
};

}  // namespace plumb::offline::bench
