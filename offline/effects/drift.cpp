// SPDX-License-Identifier: Apache-2.0
#include "effects/measurement/drift.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "effects/data_rules.hpp"
#include "effects/descriptors.hpp"

namespace plumb::offline {
namespace {

constexpr double kSettlingShares[] = {0.1, 0.3};       // of the session
constexpr double kLongestSettling_s = 30.0 * 86400.0;  // chosen: longer than any session

constexpr EffectOption kDriftOptions[] = {{
    .key = OptionKey::kSettling,
    .rule = "a number greater than 0",
    .example = "1800",
    .above = 0.0,
    .credible_least = 1.0,
    .credible_most = kLongestSettling_s,
    .credible_help = "in seconds: an arm settles within hours",
}};

constexpr GridAxis kDriftGrid[] = {{.key = OptionKey::kSettling,
                                    .kind = GridAxis::Values::kOfSession,
                                    .values = kSettlingShares,
                                    .also_without = true}};

Testability drift_testable(const DataSense& data) {
  if (!data.ordered) return cannot_show("neither time nor order is recorded");
  const std::string why =
      data.hours > 0.0 ? fmt::format("{:.1f} h of time", data.hours) : std::string("rows in order");
  return data.revisits > 2 ? can_show(why + fmt::format(", {} poses again later", data.revisits))
                           : can_show_weakly(why + ", but no pose is measured again later");
}

/// First time and length of the session, then the settling time, 0 for a drift that does not end.
void bind_drift(const EffectEntry& entry, const ConstantsSource& source, format::Effect& out) {
  const double settling = number_option(entry, OptionKey::kSettling, 0.0);
  const auto time = source.time();
  if (time)
    out.constants = {time->first, std::max(1e-9, time->last - time->first), settling};
  else
    out.constants = {0.0, 1.0, settling};
}

constexpr EffectDescriptor kDriftDescriptor{
    .name = effects::Drift::kInfo.name,
    .law = &effects::Drift::kInfo,
    .explanation =
        "Base or tracker moves slowly with time: a small motion times t, t^2 or, with settling_s "
        "= T, 1 - exp(-t/T). Typical: 50 um/h. Belongs to the measurement, not compiled. Needs: "
        "time.",
    .options = kDriftOptions,
    .joints = JointList::kNone,
    .testable = drift_testable,
    .measure = "time (t_s), and the first poses again at the end",
    .sentence = "the base or the tracker moves slowly with time",
    .search = Search::kGrid,
    .candidate_joints = CandidateJoints::kNone,
    .grid = kDriftGrid,
    .figure = "order",
    .bind = bind_drift,
};

}  // namespace

const EffectDescriptor& law_descriptor(effects::Drift) { return kDriftDescriptor; }

}  // namespace plumb::offline
