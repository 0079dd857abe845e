// SPDX-License-Identifier: Apache-2.0
/// socket_study [--diagnose] ARMS SEED: how well arms are calibrated by sockets, planes, ball bars
/// and wires, beside a tracker.
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "tests/blind/socket_findings.hpp"
#include "tests/blind/socket_marks.hpp"

namespace {

using namespace plumb::offline;
using Kind = SocketWay::Kind;
using Artefact = ArtefactPlan::Kind;

constexpr Artefact kArtefacts[] = {Artefact::kPlane, Artefact::kHeight,   Artefact::kSphere,
                                   Artefact::kBall,  Artefact::kDistance, Artefact::kWire};

void print_findings(int arms, std::uint64_t seed) {
  std::vector<SocketFindings> all;
  all.push_back(socket_findings({Kind::kTracker, 200, 10e-6}, arms, seed));
  all.push_back(socket_findings({Kind::kSockets, 200, 10e-6}, arms, seed));
  all.push_back(socket_findings({Kind::kKnownDistance, 200, 10e-6}, arms, seed));
  for (const Artefact kind : kArtefacts)
    all.push_back(socket_findings({Kind::kArtefacts, 400, 10e-6, kind}, arms, seed));
  std::puts(findings_table(all).c_str());
}

}  // namespace

int main(int argc, char** argv) {
  const bool diagnose = argc > 1 && std::string_view(argv[1]) == "--diagnose";
  if (diagnose) {
    --argc;
    ++argv;
  }
  const int arms = argc > 1 ? std::atoi(argv[1]) : 40;
  const auto seed = static_cast<std::uint64_t>(argc > 2 ? std::atoi(argv[2]) : 2040);
  if (diagnose) {
    print_findings(arms, seed);
    return 0;
  }
  std::vector<SocketMarks> all;
  for (const int readings : {20, 50, 100, 200})
    all.push_back(socket_marks({Kind::kTracker, readings, 10e-6}, arms, seed));
  for (const auto kind : {Kind::kSockets, Kind::kKnownDistance})
    for (const double play_m : {10e-6, 30e-6, 100e-6})
      for (const int readings : {20, 50, 100, 200})
        all.push_back(socket_marks({kind, readings, play_m}, arms, seed));
  for (const Artefact kind : kArtefacts)
    for (const double sigma_m : {10e-6, 50e-6})
      for (const int readings : {50, 100, 200, 400})
        all.push_back(socket_marks({Kind::kArtefacts, readings, sigma_m, kind}, arms, seed));
  std::puts(socket_table(all).c_str());
  return 0;
}
