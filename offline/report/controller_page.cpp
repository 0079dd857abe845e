// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "program/counted_words.hpp"
#include "report/page_words.hpp"
#include "report/pages.hpp"
#include "show/audit_view.hpp"
#include "show/counted.hpp"
#include "show/model_view.hpp"
#include "show/units.hpp"

namespace plumb::offline::report {
namespace {

using show::mm;

std::vector<std::string> left_out(const ReportData& data, const format::Model& model) {
  std::vector<std::string> out;
  for (const auto& effect : data.run.fit.calibration.state.arm.effects) {
    bool there = false;
    for (const auto& other : model.effects) there = there || other.name == effect.name;
    if (!there) out.push_back(effect.name);
  }
  return out;
}

void put_model(const ReportData& data, Html& html) {
  const auto& [model, audit] = *data.controller;
  std::size_t leaves = 0, numbers = 0;
  for (const auto& tree : model.trees) leaves += tree.leaves();
  for (const auto& effect : model.effects) numbers += effect.parameters.size();
  html.paragraph(fmt::format(
      "The model file takes {} bytes: the arm of {} joints, {}, and {}. How long one cycle "
      "takes is a matter of the computer beside the controller; there, plumb bench measures it.",
      audit.bytes, model.nominal.joints.size(),
      model.effects.empty() ? "no effect"
                            : counted_words(model.effects.size(), "effect", "effects") + " with " +
                                  counted_words(numbers, "number", "numbers"),
      leaves == 0 ? "no tree" : counted_words(leaves, "leaf of trees", "leaves of trees")));
  const auto left = left_out(data, model);
  if (!left.empty())
    html.paragraph(
        fmt::format("Not in the model, for it belongs to the measurement: {}. The held-out error "
                    "of this report "
                    "is with it.",
                    listed_words({show::counted(left)})));
}

void put_audit(const ReportData& data, Html& html) {
  const auto& [model, audit] = *data.controller;
  html.heading("Audit");
  html.paragraph(fmt::format(
      "Over {} poses spread over the trained range, the largest correction is {} mm; the limit of "
      "the guard is {} mm, so {}.",
      kAuditPoses, mm(audit.worst_correction_m), mm(model.guard.max_correction_m),
      audit.worst_correction_m > model.guard.max_correction_m
          ? "the guard will cut the correction at some poses"
          : "the guard cuts none of them"));
  std::vector<std::string> remarks;
  for (const auto& remark : audit.remarks) remarks.push_back(remark.message);
  html.list(remarks);
  show::Table table{.caption = "What reaches the robot", .head = {"", "value"}, .left_from = 1};
  table.rows = {
      {"corrects", show::corrected_text(model.guard)},
      {"cycle", fmt::format("{:.0f} us", model.guard.cycle_s * 1e6)},
      {"ramp in and out", fmt::format("{:g} s", model.guard.ramp_s)},
      {"farthest from the seed",
       fmt::format("{:.1f} deg", show::to_deg(model.guard.max_seed_distance))},
      {"largest turn", fmt::format("{:.4f} deg", show::to_deg(audit.worst_rotation_rad))}};
  if (!model.provenance.covariance.empty()) {
    table.rows.push_back(
        {"1 sigma of a predicted point (3-D)",
         fmt::format("mean {} mm, max {} mm", mm(audit.tool.mean_m), mm(audit.tool.max_m))});
    table.rows.push_back({"what the tool's orientation adds", show::beside_words(audit.tool)});
  }
  if (audit.leaves > 0)
    table.rows.push_back({"largest step at a leaf border", mm(audit.worst_jump_m) + " mm"});
  html.table(table);
}

void put_bus(const ReportData& data, Html& html) {
  html.heading("Bus");
  if (!data.bus) return html.paragraph(data.why_no_bus);
  const auto& layout = *data.bus;
  std::size_t frames = 0;
  show::Table table{.caption = "Messages on the bus",
                    .head = {"message", "from", "CAN id", "register", "every [ms]", "values"},
                    .left_from = 5};
  for (const auto& message : layout.messages) {
    frames += drivers::can_frames(layout, message);
    std::vector<std::string> values;
    for (const auto& signal : message.signals)
      values.push_back(signal.unit.empty() ? signal.name : signal.name + " [" + signal.unit + "]");
    table.rows.push_back(
        {message.name, message.sender == drivers::Sender::kPlumb ? "plumb-rt" : "controller",
         fmt::format("0x{:x}", message.can_id), fmt::format("{}", message.first_register),
         fmt::format("{:g}", message.period_s * 1e3), fmt::format("{}", fmt::join(values, ", "))});
  }
  html.paragraph(
      data.cell.deploy.link == drivers::BusUse::kModbus
          ? fmt::format("The controller speaks Modbus TCP: {}.",
                        counted_words(layout.messages.size(), "message", "messages"))
          : fmt::format(
                "{} in {} take at worst {:.0f} % of the CAN bus, of which {:.0f} % are allowed.",
                counted_words(layout.messages.size(), "message", "messages"),
                counted_words(frames, "frame", "frames"),
                std::ceil(100.0 * drivers::worst_bus_load(layout)), 100.0 * drivers::kMostBusLoad));
  html.table(table);
}

}  // namespace

Html controller_page(const ReportData& data, const ReportFigures& figures) {
  Html html;
  if (!data.controller) {
    html.paragraph(data.why_no_controller);
  } else {
    put_model(data, html);
    put_audit(data, html);
  }
  figures.put(Page::kController, html);
  put_bus(data, html);
  return html;
}

}  // namespace plumb::offline::report
