// SPDX-License-Identifier: Apache-2.0
#include "twin/sister.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "simulate/random.hpp"

namespace plumb::offline::twin {
namespace {

constexpr double kSizes = 0.1;  // 1 sigma of how much the size of an effect differs, relative
constexpr double kLeast = 0.5;  // of the size of the first arm

void resize(HiddenEffect& effect, sim::Random& random) {
  const auto draw = [&](std::optional<double>& size) {
    if (size) *size *= std::max(kLeast, 1.0 + kSizes * random.normal());
  };
  draw(effect.size);
  for (auto& part : effect.joints) draw(part.size);
}

}  // namespace

HiddenTruth sister_of(const Cell& cell, const Hidden& hidden, std::uint64_t number) {
  Hidden sister = hidden;
  sister.seed = sim::Random(hidden.seed, fmt::format("sister {}", number)).bits();
  HiddenTruth out = truth_of(cell, sister, hidden.seed);
  sim::Random random(sister.seed, "sizes");
  for (auto& effect : out.sized) resize(effect, random);
  return out;
}

Cell cell_of_sister(Cell cell, std::uint64_t number, const std::filesystem::path& measurements) {
  cell.directory = std::filesystem::absolute(measurements).parent_path();
  cell.serial += fmt::format("-SISTER-{}", number);
  cell.name += fmt::format(", sister {}", number);
  cell.measurement.files = {std::filesystem::absolute(measurements)};
  cell.fit.prior_from.clear();
  cell.fit.earlier.reset();
  return cell;
}

}  // namespace plumb::offline::twin
