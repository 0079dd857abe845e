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
#include "rt/journal.hpp"
#include "rt/notify.hpp"
#include "rt/record_writer.hpp"
#include "rt/status_text.hpp"

namespace plumb::drivers::rt {

/// All slow tasks of a run, on a thread of its own without real-time priority: control socket,
/// metrics, model swap, record, file of answers, service manager, recovery of links.
///
/// It shares RunShared and the model slot with the cycle's thread, which never waits for them.
class Service {
 public:
  /// Whether the files of record and answers are created, or only checked (kChecked) for a service
  /// that will not be started.
  enum class Files : std::uint8_t { kMade, kChecked };

  /// Opens sockets and files; throws Failure (kEnvironment) where that fails.
  Service(Deployment& deployment, OpenBus& bus, ModelSlot& slot, RunShared& shared, Files files);
  ~Service();
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;

  void start();
  void stop();  // after the end of the cycle's thread; writes what is left

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
  std::string swap(const struct SwapRequest& request);
  void note_swap(const std::string& file, const std::string& answer);
  std::string page(const std::string& request);

  Deployment& deployment_;
  OpenBus& bus_;
  ModelSlot& slot_;
  RunShared& shared_;
  ServiceManager manager_;
  ControlSocket control_;
  std::optional<Descriptor> metrics_;
  Journal journal_;
  std::unique_ptr<RecordWriter> record_;
  std::unique_ptr<class AnswerFile> answers_;
  RunFacts facts_;
  RunSnapshot snapshot_;
  RunningModel next_;  // the model before, kept while the cycle may still use it
  std::int64_t told_ns_ = 0;
  std::uint64_t told_beats_ = 0;
  bool ready_ = false;
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

}  // namespace plumb::drivers::rt
