// SPDX-License-Identifier: Apache-2.0
#include "cli/run_number.hpp"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>

#include "program/problem.hpp"

namespace plumb::offline::cli {

int run_number(const std::string& text) {
  const std::string digits = std::filesystem::path(text).filename().string();
  int number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error == std::errc{} && end == digits.data() + digits.size() && number > 0) return number;
  throw Failure(Exit::kUsage, {.code = "E-USAGE",
                               .message = fmt::format("'{}' is not the number of a run", text),
                               .help = "list them: plumb runs"});
}

}  // namespace plumb::offline::cli
