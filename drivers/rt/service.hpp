// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <thread>

#include "plumb/drivers/run_shared.hpp"
#include "plumb/runtime/model_slot.hpp"
#include "rt/bus_source.hpp"
#include "rt/control_path.hpp"
#include "rt/deployment.hpp"
#include "rt/journal.hpp"
#include "rt/last_run.hpp"
#include "rt/model_swap.hpp"
#include "rt/notify.hpp"
#include "rt/recorder.hpp"
#include "rt/status_text.hpp"

namespace plumb::drivers::rt {

/// All slow tasks of a run, on a thread of its own without real-time priority: control socket,
/// metrics, model swap, journal, service manager, recovery of links, what the next run must know.
/// Record and file of answers are written on another thread (recorder.hpp), and a model is loaded
/// on yet another one, so that a slow disk holds up nothing.
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

  /// After the end of the cycle's thread; writes what is left. `ended`: whether the next run may
  /// take this one for one that ended well. False if the thread has not ended within kStop_s, held
  /// up by a disk that does not answer; then only the end of the program is left.
  enum class Ended : std::uint8_t { kWell, kBadly };
  [[nodiscard]] bool stop(Ended ended);
  static constexpr double kStop_s = 3.0;

  /// Why an operator must acknowledge before the first correction; empty: that is not needed.
  const std::string& acknowledgement() const noexcept { return facts_.acknowledge; }

  const RunSnapshot& snapshot() const noexcept { return snapshot_; }  // after stop()
  const RunFacts& facts() const noexcept { return facts_; }

 private:
  void make_files();
  Recorder::Files recorder_files() const;
  void run();
  void pass();
  void write_down();
  void note_state(const SessionMoment& moment);
  void note_packing();
  void tell_manager();
  void serve();
  void serve_control();
  std::string control(const std::string& request) const;
  void look_at_place();
  void repeat_unsigned();
  void remember();
  std::string page(const std::string& request);

  Deployment& deployment_;
  OpenBus& bus_;
  RunShared& shared_;
  ServiceManager manager_;
  ControlSocket control_;
  std::optional<Descriptor> metrics_;
  ReserveDescriptor reserve_;  // before the files that are opened and closed again
  Journal journal_;
  std::unique_ptr<Recorder> recorder_;  // none for a service that is not started
  RunFacts facts_;
  RunSnapshot snapshot_;
  RegisterPacking packing_;                   // that the journal has
  SessionState state_ = SessionState::kInit;  // whose cause is in facts_
  ModelSwap swap_;
  std::optional<LastRun> last_run_;  // none for targets from a file
  std::int64_t told_ns_ = 0;
  std::uint64_t told_beats_ = 0;
  std::int64_t unsigned_ns_ = 0;  // when the journal last said that what runs is unsigned
  bool ready_ = false;
  std::atomic<bool> ended_{false};
  std::atomic<bool> over_{false};  // the thread has ended
  std::thread thread_;
};

}  // namespace plumb::drivers::rt
