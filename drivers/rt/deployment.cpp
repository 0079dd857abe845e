// SPDX-License-Identifier: Apache-2.0
#include "rt/deployment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "bus_text/layout_toml.hpp"
#include "bus_text/reach.hpp"
#include "plumb/drivers/bus_content.hpp"
#include "program/file.hpp"
#include "program/shell_word.hpp"
#include "rt/check_sums.hpp"

namespace plumb::drivers::rt {
namespace {

void complete(Deployment& out) {
  SessionSettings& session = out.session = out.config.session;
  const double cycle_s = 1e-6 * out.config.cycle_us;
  session.robot = fingerprint(out.model.loaded->model().serial);
  session.form = out.config.sink.kind == SinkConfig::Kind::kCsv ? CorrectionForm::kPose
                                                                : out.layout.correction;
  session.sensors = sensor_places(out.layout, out.model.loaded->model());
  session.target.period_s = cycle_s;
  if (const auto* target = out.layout.find(MessageKind::kTarget))
    session.target.period_s = target->period_s;
  session.cycle_s = cycle_s;
  if (!out.config.source->has_robot()) {  // a row of the file stands for the arm until it is synced
    session.sync.distinct = 1;
    session.arm.lag_s = std::numeric_limits<double>::infinity();
  }
  session.answer_s = std::max(session.answer_s, 3.0 * cycle_s);
  if (const auto* status = out.layout.find(MessageKind::kStatus))
    session.status_s = status->period_s;
  if (const auto* signature = out.layout.find(MessageKind::kSignature))
    session.signature_s = signature->period_s;
}

}  // namespace

std::vector<LayoutFault> find_short_reach(const Deployment& deployment, const LoadedModel& model) {
  if (deployment.config.source->use() != BusUse::kCan) return {};
  return drivers::find_short_reach(deployment.layout, model.model().nominal,
                                   model.limits().max_correction_m, "bus");
}

bool sensors_come(const Deployment& deployment, const LoadedModel& model) {
  const SensorPlaces own = sensor_places(deployment.layout, model.model());
  const SensorPlaces& told = deployment.session.sensors;
  return std::equal(own.begin(), own.end(), told.begin(),
                    [](int wanted, int there) { return wanted < 0 || wanted == there; });
}

BusLayout record_layout(const Deployment& deployment) {
  BusLayout out = deployment.layout;
  if (deployment.config.source->use() != BusUse::kCan) out.can_format = CanFrame::Format::kFd;
  return out;
}

void refuse_wider(const std::filesystem::path& file, const LoadedModel& model,
                  const Ceilings& ceilings, const std::filesystem::path& folder) {
  std::vector<Problem> problems;
  for (const WiderLimit& wider : wider_limits(model.limits(), ceilings))
    problems.push_back(
        {.severity = Severity::kError,
         .code = "E-RT-CEILING",
         .message = fmt::format("{} allows {}", display_name(file), wider.text()),
         .help = fmt::format("if that is meant: {} = {:.4g} in rt.toml, then: plumb-rt seal {}",
                             wider.key, wider.model, shell_word(display_name(folder)))});
  if (!problems.empty()) throw Failure(Exit::kInput, std::move(problems));
}

Deployment load_deployment(const std::filesystem::path& folder, Sums sums) {
  Deployment out;
  out.folder = folder;
  const std::filesystem::path file = folder / "rt.toml";
  TomlSource source(display_name(file), read_file(file), "E-RT");
  const toml::table parsed = source.parse();
  TomlTable top(parsed, "", source);
  out.config = read_rt_config(top, folder);
  auto bus = top.table("bus");
  top.done();
  source.stop_on_errors();
  if (sums == Sums::kVerified) verify_sums(folder, out.config.model);
  out.model = load_model(out.config.model, out.config.serial);
  refuse_wider(out.config.model, *out.model.loaded, out.config.ceilings, folder);
  const BusArm arm = bus_arm(out.model.loaded->model().nominal, 1e-6 * out.config.cycle_us);
  const toml::table nothing;
  TomlTable absent(nothing, "bus", source);
  TomlTable& table = bus ? *bus : absent;
  out.layout = read_bus(table, arm, out.config.source->use(), MissingOwner::kNone);
  source.stop_on_errors();
  for (const LayoutFault& fault : find_short_reach(out, *out.model.loaded))
    report_fault(table, fault);
  source.stop_on_errors();
  complete(out);
  return out;
}

}  // namespace plumb::drivers::rt
