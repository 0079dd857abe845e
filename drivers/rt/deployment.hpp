// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "plumb/drivers/bus_layout.hpp"
#include "rt/rt_config.hpp"
#include "rt/running_model.hpp"

namespace plumb::drivers::rt {

/// The verified content of a folder that `plumb deploy` wrote: rt.toml, the model and the layout.
struct Deployment {
  std::filesystem::path folder;
  RtConfig config;
  RunningModel model;
  BusLayout layout;
  SessionSettings session;  // from the configuration, completed from model and layout
};

/// The quantities of this model that exceed the range of numbers on the deployment's bus. `model`:
/// that of the deployment, or one that shall replace it. Empty if all fit. Slow.
std::vector<LayoutFault> find_short_reach(const Deployment& deployment, const LoadedModel& model);

/// True if the running session already reads from message `context` every sensor that this model
/// needs and the bus transmits. Slow.
bool sensors_come(const Deployment& deployment, const LoadedModel& model);

/// The layout in which the record is written: that of the bus if it is CAN, else its CAN FD
/// variant, which represents all values of other buses exactly.
BusLayout record_layout(const Deployment& deployment);

/// Throws Failure (kInput, E-RT-CEILING) if a limit of this model, read from `file`, is wider than
/// the ceilings of [limits].
void refuse_wider(const std::filesystem::path& file, const LoadedModel& model,
                  const Ceilings& ceilings, const std::filesystem::path& folder);

/// Whether the files must be those that SHA256SUMS lists; `plumb-rt seal` writes the list anew.
enum class Sums : std::uint8_t { kVerified, kIgnored };

/// Reads and verifies a folder without opening a bus. Throws Failure (kInput) with everything that
/// is wrong: codes E-RT-..., E-TOML. Slow.
Deployment load_deployment(const std::filesystem::path& folder, Sums sums = Sums::kVerified);

}  // namespace plumb::drivers::rt
