// SPDX-License-Identifier: Apache-2.0
#include "cli/start_joints.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <sstream>

#include "plumb/runtime/coupling.hpp"
#include "program/problem.hpp"
#include "show/units.hpp"

namespace plumb::offline::cli {
namespace {

/// "0,-90,90" as numbers. Split here, because the option parser takes the next word of the command
/// line for a number where nothing stands between commas.
std::vector<double> start_numbers(const std::string& text) {
  std::vector<double> out;
  std::istringstream in(text + ",");
  for (std::string word; std::getline(in, word, ',');) {
    char* end = nullptr;
    const double number = std::strtod(word.c_str(), &end);
    if (word.empty() || *end != '\0' || !std::isfinite(number))
      throw Failure(Exit::kUsage, {.code = "E-USAGE",
                                   .message = fmt::format("--start holds '{}'", word),
                                   .help = "give one number a joint, deg or mm: "
                                           "--start 0,-90,90,0,90,0"});
    out.push_back(number);
  }
  return out;
}

}  // namespace

std::vector<double> start_of(const std::optional<std::string>& text, const format::Chain& chain) {
  if (!text) return {};
  const std::vector<double> start = start_numbers(*text);
  if (start.size() != chain.joints.size())
    throw Failure(Exit::kUsage,
                  {.code = "E-USAGE",
                   .message = fmt::format("--start has {} numbers, the arm {} joints", start.size(),
                                          chain.joints.size()),
                   .help = "give one number a joint, deg or mm, with commas between"});
  std::vector<double> out;
  for (std::size_t i = 0; i < start.size(); ++i)
    out.push_back(show::slides(chain.joints[i]) ? start[i] * 1e-3 : show::from_deg(start[i]));
  Coupling(chain.coupling).to_angles(out);
  return out;
}

}  // namespace plumb::offline::cli
