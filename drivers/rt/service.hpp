// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <thread>

#include "plumb/drivers/run_shared.hpp"
#include "plumb/runtime/model_slot.hpp"
#include "rt/bus_source.hpp"
#include "rt/control_path.hpp"
#include "rt/deployment.hpp"
#include "rt/notify.hpp"
#include "rt/record_writer.hpp"
#include "rt/status_text.hpp"

namespace plumb::drivers::rt {

/// Everything slow of a run, on a thread of its own without real-time priority: control socket,
/// metrics, model swap, record, answers to a file, service manager, links that are down.
///
/// The cycle's thread shares RunShared and the model slot with it, and waits for neither.
class Service {
 public:
  /// Of record and answers. kChecked: none is made, for a service that is not to start.
  enum class Files : std::uint8_t { kMade, kChecked };

  /// Opens sockets and files; throws Failure (kEnvironment) where that fails.
  Service(Deployment& deployment, OpenBus& bus, ModelSlot& slot, RunShared& shared, Files files);
  ~Service();
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;

  void start();
  void stop();  // when the cycle's thread is done: writes what is left

  const RunSnapshot& snapshot() const noexcept { return snapshot_; }  // after stop()
  const RunFacts& facts() const noexcept { return facts_; }

 private:
  void make_files();
  void check_files() const;
  void run();
  void pass();
  void write_down();
  void tell_manager();
  void serve();
  std::string control(const std::string& request);
  std::string swap(const std::string& file);
  std::string page(const std::string& request);

  Deployment& deployment_;
  OpenBus& bus_;
  ModelSlot& slot_;
  RunShared& shared_;
  ServiceManager manager_;
  ControlSocket control_;
  std::optional<Descriptor> metrics_;
  std::unique_ptr<RecordWriter> record_;
  std::unique_ptr<class AnswerFile> answers_;
  RunFacts facts_;
  RunSnapshot snapshot_;
  RunningModel next_;  // published, or what the cycle has left
  std::int64_t told_ns_ = 0;
  std::uint64_t told_beats_ = 0;
  bool ready_ = false;
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

}  // namespace plumb::drivers::rt
