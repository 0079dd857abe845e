// SPDX-License-Identifier: Apache-2.0
#include "rt/csv_source.hpp"

#include "rt/csv_port.hpp"

namespace plumb::drivers::rt {
namespace {

class CsvBus final : public OpenBus {
 public:
  CsvBus(const std::filesystem::path& file, const BusTask& task)
      : port_(read_csv_targets(file, joints(task)), task.model, task.session.robot,
              task.record_layout, lead(task)) {}
  BusPort& port() noexcept override { return port_; }
  bool finished() const noexcept override { return port_.finished(); }

 private:
  static int joints(const BusTask& task) { return task.model.corrector().nominal().joints(); }
  /// The number of cycles until the session has compared poses, waited for its inputs and ramped
  /// in.
  static int lead(const BusTask& task) {
    const SessionSettings& session = task.session;
    const double s = session.rearm_s + 2.0 * task.model.limits().ramp_s;
    return session.sync.poses + 10 + static_cast<int>(s / session.cycle_s);
  }

  CsvPort port_;
};

}  // namespace

std::shared_ptr<const BusSource> CsvSource::read(TomlTable& source,
                                                 const std::filesystem::path& folder) {
  auto out = std::make_shared<CsvSource>();
  const std::string name = source.text_or("file", "");
  if (name.empty()) source.missing("file", "file = \"targets.csv\"");
  out->file = folder / name;
  return out;
}

std::unique_ptr<OpenBus> CsvSource::open(const BusTask& task) const {
  return std::make_unique<CsvBus>(file, task);
}

}  // namespace plumb::drivers::rt
