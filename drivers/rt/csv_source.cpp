// SPDX-License-Identifier: Apache-2.0
#include "rt/csv_source.hpp"

#include "rt/csv_port.hpp"
#include "rt/deployment.hpp"

namespace plumb::drivers::rt {
namespace {

class CsvBus final : public OpenBus {
 public:
  CsvBus(const std::filesystem::path& file, const Deployment& deployment)
      : port_(read_csv_targets(file, joints(deployment)), *deployment.model.loaded,
              deployment.session.robot, record_layout(deployment), lead(deployment)) {}
  BusPort& port() noexcept override { return port_; }
  bool finished() const noexcept override { return port_.finished(); }

 private:
  static int joints(const Deployment& deployment) {
    return deployment.model.loaded->corrector().nominal().joints();
  }
  /// The number of cycles until the session has compared poses, waited for its inputs and ramped
  /// in.
  static int lead(const Deployment& deployment) {
    const SessionSettings& session = deployment.session;
    const double s = session.rearm_s + 2.0 * deployment.model.loaded->limits().ramp_s;
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

std::unique_ptr<OpenBus> CsvSource::open(const Deployment& deployment) const {
  return std::make_unique<CsvBus>(file, deployment);
}

}  // namespace plumb::drivers::rt
