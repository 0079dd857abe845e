// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "plumb/drivers/bus_layout.hpp"
#include "rt/rt_config.hpp"
#include "rt/running_model.hpp"

namespace plumb::drivers::rt {

/// A folder that `plumb deploy` wrote, read and found good: rt.toml, the model, and the layout.
struct Deployment {
  std::filesystem::path folder;
  RtConfig config;
  RunningModel model;
  BusLayout layout;
  SessionSettings session;  // of the configuration, completed by model and layout
};

/// What the numbers of the deployment's bus are too small for with a model: its own, or one that is
/// to take its place. Empty: fits. Slow.
std::vector<LayoutFault> find_short_reach(const Deployment& deployment, const LoadedModel& model);

/// The session that runs finds in message context every sensor that this model reads and the bus
/// brings. Slow.
bool sensors_come(const Deployment& deployment, const LoadedModel& model);

/// The layout that the record is written in: of the bus if that is CAN, else its FD variant, which
/// loses nothing of what other buses carry.
BusLayout record_layout(const Deployment& deployment);

/// Throws Failure (kInput) with everything that is wrong: codes E-RT-..., E-TOML. Sends nothing,
/// opens no bus. Slow.
Deployment load_deployment(const std::filesystem::path& folder);

}  // namespace plumb::drivers::rt
