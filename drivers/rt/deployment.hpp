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
  std::filesystem::path folder;   // that the user named: a place, or the deploy folder itself. The
                                  // control socket, journal and state belong to it
  std::filesystem::path content;  // the deploy folder: a version of the place, or `folder`
  std::string sums;               // the text of its SHA256SUMS; empty if that was not verified
  RtConfig config;
  RunningModel model;
  BusLayout layout;
  SessionSettings session;          // from the configuration, completed from model and layout
  std::filesystem::path etc;        // the folder of the machine's settings that it was judged by
  bool demands_signatures = false;  // by those settings, although it may run without one
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

/// Reads and verifies a folder without opening a bus; of a place the version that is current. With
/// `rules` its signature, too, and if that is good that nothing else stands in the folder; without
/// them the origin is left empty, which is for what sends nothing, such as a replay. Throws Failure
/// (kInput) with everything that is wrong: codes E-RT-..., E-TOML. Slow.
Deployment load_deployment(const std::filesystem::path& folder, Sums sums = Sums::kVerified,
                           const SigningRules* rules = nullptr);

/// Reads a model that shall replace the running one. Where signatures are demanded it must be one
/// of the files of a signed folder, its own, all of which is verified; `written` are files that
/// plumb-rt may have written there. A model of a place must be one of its versions. Throws Failure
/// (kInput) as load_model and load_deployment do. Slow.
struct NextModel {
  std::filesystem::path file;
  std::string serial;
  std::filesystem::path etc;
  std::filesystem::path place;  // empty: a deploy folder runs
  std::vector<std::filesystem::path> written;
};
RunningModel load_next_model(const NextModel& next);

}  // namespace plumb::drivers::rt
