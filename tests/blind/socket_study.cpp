// SPDX-License-Identifier: Apache-2.0
/// socket_study ARMS SEED: how well arms are calibrated by sockets, planes, ball bars and
/// wires, beside a tracker.
#include <cstdio>
#include <cstdlib>

#include "tests/blind/socket_marks.hpp"

int main(int argc, char** argv) {
  using namespace plumb::offline;
  using Kind = SocketWay::Kind;
  const int arms = argc > 1 ? std::atoi(argv[1]) : 40;
  const auto seed = static_cast<std::uint64_t>(argc > 2 ? std::atoi(argv[2]) : 2040);
  std::vector<SocketMarks> all;
  for (const int readings : {20, 50, 100, 200})
    all.push_back(socket_marks({Kind::kTracker, readings, 10e-6}, arms, seed));
  for (const auto kind : {Kind::kSockets, Kind::kKnownDistance})
    for (const double play_m : {10e-6, 30e-6, 100e-6})
      for (const int readings : {20, 50, 100, 200})
        all.push_back(socket_marks({kind, readings, play_m}, arms, seed));
  using Artefact = ArtefactPlan::Kind;
  for (const auto kind : {Artefact::kPlane, Artefact::kHeight, Artefact::kSphere, Artefact::kBall,
                          Artefact::kDistance, Artefact::kWire})
    for (const double sigma_m : {10e-6, 50e-6})
      for (const int readings : {50, 100, 200, 400})
        all.push_back(socket_marks({Kind::kArtefacts, readings, sigma_m, kind}, arms, seed));
  std::puts(socket_table(all).c_str());
  return 0;
}
