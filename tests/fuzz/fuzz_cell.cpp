// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdint>
#include <string>

#include "cell/cell.hpp"
#include "tests/fuzz/refusals.hpp"

using namespace plumb::offline;
using plumb::tests::require;
using plumb::tests::require_helpful;

/// Any bytes are a sound cell, which is written and read back the same, or a helpful refusal.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::filesystem::path file = "/cell/cell.toml";
  Cell cell;
  try {
    cell = parse_cell(std::string(reinterpret_cast<const char*>(data), size), file);
  } catch (const plumb::Failure& failure) {
    require_helpful(failure);
    return 0;
  }
  for (const auto& joint : cell.nominal.joints)
    for (double v : {joint.a, joint.d, joint.alpha, joint.theta, joint.q_min, joint.q_max})
      require(std::isfinite(v), "numbers are finite");
  try {
    const Cell again = parse_cell(write_cell(cell), file);
    require(again.joints() == cell.joints(), "what is written is read back");
    require(again.effects.size() == cell.effects.size(), "effects are read back");
  } catch (const plumb::Failure& failure) {
    std::fputs(failure.what(), stderr);
    require(false, "what is written can be read");
  }
  return 0;
}
