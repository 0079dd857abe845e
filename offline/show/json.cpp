// SPDX-License-Identifier: Apache-2.0
#include "show/json.hpp"

#include "show/units.hpp"

namespace plumb::offline::show {

Json stats_json(const ErrorStats& stats) {
  Json out{{"n", stats.n}};
  const std::pair<const char*, double> figures[] = {
      {"mean_mm", stats.mean}, {"rms_mm", stats.rms}, {"p95_mm", stats.p95}, {"max_mm", stats.max}};
  for (const auto& [key, value] : figures) {
    if (stats.n == 0)
      put_null(out, key, "no pose belongs to this set");
    else
      put(out, key, to_mm(value));
  }
  return out;
}

Json pose_json(const format::Pose& pose) {
  return {{"xyz_mm", {to_mm(pose.p[0]), to_mm(pose.p[1]), to_mm(pose.p[2])}},
          {"quat_wxyz", pose.q}};
}

Json coupling_json(const std::vector<format::JointCoupling>& coupling) {
  Json out = Json::array();
  for (const auto& [joint, by, ratio] : coupling)
    out.push_back({{"joint", joint + 1}, {"by", by + 1}, {"ratio", ratio}});
  return out;
}

}  // namespace plumb::offline::show
