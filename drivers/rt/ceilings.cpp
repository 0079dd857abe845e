// SPDX-License-Identifier: Apache-2.0
#include "rt/ceilings.hpp"

#include <fmt/format.h>

#include "rt/screen_units.hpp"

namespace plumb::drivers::rt {
namespace {

/// rt.toml states its numbers in decimal digits, so that they may end a little below the model's.
constexpr double kRounding = 1e-6;

/// The widest that a key may be set to: no arm is corrected by more, and a ceiling beyond it would
/// be none.
struct CeilingKey {
  const char* name;
  double unit;
  double most;  // in the unit
  double Ceilings::*value;
};

constexpr CeilingKey kCeilingKeys[] = {
    {"max_correction_mm", kMilli, 50.0, &Ceilings::correction_m},
    {"max_rotation_deg", kDegree, 90.0, &Ceilings::rotation_rad},
    {"max_slew_mm_s", kMilli, 200.0, &Ceilings::slew_m_s},
    {"max_slew_deg_s", kDegree, 90.0, &Ceilings::slew_rad_s},
    {"min_ramp_s", 1.0, 60.0, &Ceilings::ramp_s},
    {"max_change_mm", kMilli, 50.0, &Ceilings::change_m},
    {"max_change_deg", kDegree, 90.0, &Ceilings::change_rad},
};

}  // namespace

void read_ceilings(TomlTable& table, Ceilings& out) {
  for (const CeilingKey& key : kCeilingKeys) {
    const auto value = table.positive(key.name);
    if (!value) continue;
    if (*value > key.most)
      table.out_of_range(key.name, fmt::format("greater than 0, {:g} at most", key.most));
    out.*key.value = *value * key.unit;
  }
}

std::string WiderLimit::text() const {
  return fmt::format("{} {:.4g} {}, and [limits] {} is {:.4g}", what, model, unit, key, ceiling);
}

std::vector<WiderLimit> wider_limits(const format::GuardLimits& model, const Ceilings& ceilings) {
  std::vector<WiderLimit> out;
  const auto most = [&out](WiderLimit one, double unit) {
    if (!(one.model <= one.ceiling * (1.0 + kRounding))) {
      one.model /= unit;
      one.ceiling /= unit;
      out.push_back(one);
    }
  };
  most({"max_correction_mm", "corrections of up to", model.max_correction_m, ceilings.correction_m,
        "mm"},
       kMilli);
  most({"max_slew_mm_s", "changes of up to", model.slew_m_per_s, ceilings.slew_m_s, "mm/s"},
       kMilli);
  if (model.corrects == format::Corrects::kPose) {
    most({"max_rotation_deg", "rotations of up to", model.max_rotation_rad, ceilings.rotation_rad,
          "deg"},
         kDegree);
    most({"max_slew_deg_s", "turning at up to", model.slew_rad_per_s, ceilings.slew_rad_s, "deg/s"},
         kDegree);
  }
  if (!(model.ramp_s >= ceilings.ramp_s * (1.0 - kRounding)))
    out.push_back({"min_ramp_s", "a ramp of only", model.ramp_s, ceilings.ramp_s, "s"});
  return out;
}

}  // namespace plumb::drivers::rt
