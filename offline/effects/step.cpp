// SPDX-License-Identifier: Apache-2.0
#include "effects/measurement/step.hpp"

#include <fmt/format.h>

#include <string>

#include "effects/data_rules.hpp"
#include "effects/descriptors.hpp"

namespace plumb::offline {
namespace {

constexpr const char* kMoved[] = {"tool", "base", "joint"};
constexpr OptionKey kStepToldApartBy = OptionKey::kOf;

constexpr EffectOption kStepOptions[] = {
    {.key = OptionKey::kAfterRow,
     .takes = EffectOption::Takes::kWhole,
     .rule = "a whole number of 1 or more: the last row before it",
     .example = "84",
     .least = 1.0,
     .required = true,
     .lists = true},
    {.key = OptionKey::kOf,
     .takes = EffectOption::Takes::kWord,
     .rule = "\"tool\", \"base\" or \"joint\"",
     .example = "tool",
     .words = kMoved,
     .assumed = "tool"}};

Testability step_testable(const DataSense& data) {
  if (!data.ordered) return can_show_weakly("the rows are taken to be in the order of measuring");
  return can_show("rows in order");
}

std::string step_title(const EffectEntry& entry, const std::string& joint) {
  const std::string moved = text_option(entry, OptionKey::kOf, "");
  std::string out = "step";
  if (!joint.empty())
    out += " of the encoder of " + joint;
  else if (!moved.empty())
    out += " of the " + (moved == "joint" ? "encoder" : moved);
  if (has_option(entry, OptionKey::kAfterRow))
    out += fmt::format(" after row {:g}", number_option(entry, OptionKey::kAfterRow, 0.0));
  return out;
}

/// Halfway between the last row before the step and the next one; then the number of what moved.
void bind_step(const EffectEntry& entry, const ConstantsSource&, format::Effect& out) {
  const double row = number_option(entry, OptionKey::kAfterRow, -1.0);
  if (row < 1.0)
    refuse_effect(entry, "does not say when", "after_row = 84   # the last row before it");
  const std::string of = text_option(entry, OptionKey::kOf, "tool");
  out.constants = {row - 0.5, of == "base" ? 1.0 : of == "joint" ? 2.0 : 0.0};
}

std::string step_infix(const format::Effect& effect) {
  return fmt::format(".row{:g}", effect.constants[0] + 0.5);
}

constexpr EffectDescriptor kStepDescriptor{
    .name = effects::Step::kInfo.name,
    .law = &effects::Step::kInfo,
    .explanation =
        "From some pose on all is shifted: a reflector re-seated, a tracker bumped, an encoder "
        "slipped. Belongs to the measurement. Needs: order of poses. Looked for before drift.",
    .options = kStepOptions,
    .joints = JointList::kOneIfEncoder,
    .testable = step_testable,
    .measure = "time (t_s) or rows in order; the first poses again at the end",
    .entry_title = step_title,
    .search = Search::kChangePoint,
    .told_apart_by = &kStepToldApartBy,
    .figure = "order",
    .bind = bind_step,
    .parameter_infix = step_infix,
};

}  // namespace

const EffectDescriptor& law_descriptor(effects::Step) { return kStepDescriptor; }

}  // namespace plumb::offline
