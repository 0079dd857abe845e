// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "rt/check.hpp"
#include "rt/running_place.hpp"

namespace plumb::drivers::rt {
namespace {

/// Empty also if it is not known: nobody runs the place, or he does not answer to this user.
std::string packing_in(const InstallPlace& place) {
  try {
    const auto running = find_running(place);
    return running ? running->packing : "";
  } catch (const Failure&) {
    return "";
  }
}

}  // namespace

std::vector<Check> packing_checks(const std::filesystem::path& store) {
  std::vector<Check> out;
  for (const std::string& name : places_below(store))
    if (const std::string packing = packing_in({store / name}); !packing.empty())
      out.push_back({.id = "packing",
                     .finding = {.what = "registers",
                                 .grant = Grant::kDenied,
                                 .why = fmt::format("{}: {}", name, packing)}});
  return out;
}

}  // namespace plumb::drivers::rt
