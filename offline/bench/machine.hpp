// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bench/build.hpp"

namespace plumb::offline::bench {

using CpuSet = std::set<int>;

/// The machine on which something is timed. A member is empty if the machine does not state it.
struct Machine {
  std::string kernel;  // release
  bool preempt_rt = false;
  std::string cpu;                      // model
  int cpus = 0;                         // online
  CpuSet allowed;                       // on which this thread may run
  CpuSet isolated;                      // kept free of other work
  CpuSet siblings;                      // share a core with one of `allowed`, itself not counted
  std::set<std::string> governors;      // of `allowed`
  std::optional<bool> virtual_machine;  // none: it cannot be told
  std::optional<double> load;           // average of the last minute
};

/// What /proc and /sys below `root` say, and where this thread may run.
Machine look_at_machine(const std::filesystem::path& root = "/");

/// Why times taken there are not those of a controller, each in a few words; empty if they may be.
/// A controller's PC is bare metal with an isolated core at full clock, and at rest otherwise.
std::vector<std::string> why_not_representative(const Machine& machine, const Build& build);

/// The reasons as one sentence that is shown with every time.
std::string fitness_text(const std::vector<std::string>& why_not);

/// "0-2,5", as the kernel writes it.
CpuSet parse_cpus(const std::string& list);
std::string cpu_list(const CpuSet& cpus);

}  // namespace plumb::offline::bench
