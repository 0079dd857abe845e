// SPDX-License-Identifier: Apache-2.0
#include "show/audit_view.hpp"

#include <fmt/format.h>

#include "cell/joint_columns.hpp"
#include "show/table.hpp"
#include "show/units.hpp"

namespace plumb::offline::show {
namespace {

constexpr const char* kNoCovariance = "the model carries no covariance";

Json worst_q_json(const Audit& audit, const format::Model& model) {
  Json out = Json::object();
  const auto q = values_at(audit.worst_q, model.nominal);
  for (std::size_t i = 0; i < q.size(); ++i) {
    const auto& row = model.nominal.joints[i];
    out[fmt::format("q{}_{}", i + 1, unit(slides(row)))] = shown(q[i], slides(row));
  }
  return out;
}

std::string worst_q_text(const Audit& audit, const format::Model& model) {
  std::string out;
  const auto q = values_at(audit.worst_q, model.nominal);
  for (std::size_t i = 0; i < q.size(); ++i)
    out +=
        fmt::format("{}{:.1f}", i == 0 ? "" : ", ", shown(q[i], slides(model.nominal.joints[i])));
  return out;
}

/// [{joint, at_deg, within_deg, pct}], of a prismatic joint at_mm and within_mm.
Json refused_where_json(const Audit& audit, const format::Model& model) {
  Json out = Json::array();
  for (const RefusedPlace& place : audit.refusals.places) {
    const auto& row = model.nominal.joints[place.joint];
    const bool slides = row.type == format::JointType::kPrismatic;
    Json one{{"joint", row.name}};
    put(one, slides ? "at_mm" : "at_deg", slides ? to_mm(place.at) : to_deg(place.at));
    put(one, slides ? "within_mm" : "within_deg",
        slides ? to_mm(place.within) : to_deg(place.within));
    put(one, "pct", 100.0 * place.share);
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace

Json audit_json(const Audit& audit, const format::Model& model) {
  Json out;
  put(out, "worst_correction_mm", to_mm(audit.worst_correction_m));
  put(out, "worst_rotation_deg", to_deg(audit.worst_rotation_rad));
  out["worst_at"] = worst_q_json(audit, model);
  put(out, "max_correction_mm", to_mm(model.guard.max_correction_m));
  put(out, "worst_leaf_jump_mm", to_mm(audit.worst_jump_m));
  if (model.provenance.covariance.empty()) {
    put_null(out, "sigma_tool_mean_mm", kNoCovariance);
    put_null(out, "sigma_tool_max_mm", kNoCovariance);
    put_null(out, "sigma_beside_mm", kNoCovariance);
  } else {
    put(out, "sigma_tool_mean_mm", to_mm(audit.tool.mean_m));
    put(out, "sigma_tool_max_mm", to_mm(audit.tool.max_m));
    put(out, "sigma_beside_mm", to_mm(audit.tool.beside_m));
  }
  out["leaves"] = audit.leaves;
  out["active_leaves"] = audit.active_leaves;
  out["bytes"] = audit.bytes;
  out["poses_looked_at"] = kAuditPoses;
  put(out, "refused_in_range_pct", 100.0 * audit.refusals.trained.refused);
  put(out, "partial_in_range_pct", 100.0 * audit.refusals.trained.partial);
  put(out, "refused_pct", 100.0 * audit.refusals.limits.refused);
  put(out, "partial_pct", 100.0 * audit.refusals.limits.partial);
  out["refused_where"] = refused_where_json(audit, model);
  return out;
}

std::string beside_words(const ToolUncertainty& tool) {
  return fmt::format(
      "{} mm at a point {:.0f} mm away{}", mm(tool.beside_m), to_mm(kBeside_m),
      tool.turn_unmeasured ? ", because positions do not show how the last link is turned" : "");
}

std::string audit_text(const Audit& audit, const format::Model& model) {
  Table table{.head = {fmt::format("audit of {} poses in the domain", kAuditPoses), ""}};
  table.add({"largest correction at the tool",
             model.guard.corrects == format::Corrects::kPose
                 ? fmt::format("{} mm, {:.4f} deg", mm(audit.worst_correction_m),
                               to_deg(audit.worst_rotation_rad))
                 : mm(audit.worst_correction_m) + " mm"});
  if (!audit.worst_q.empty()) table.add({"  at joints", worst_q_text(audit, model)});
  table.add({"limit of the guard", mm(model.guard.max_correction_m) + " mm"});
  if (!model.provenance.covariance.empty()) {
    table.add({"3-D sigma of the fit at the tool",
               fmt::format("mean {} mm, max {} mm", mm(audit.tool.mean_m), mm(audit.tool.max_m))});
    table.add({"  what its orientation adds", beside_words(audit.tool)});
  }
  table.add({"leaves", fmt::format("{}", audit.leaves)});
  if (audit.leaves > 0) {
    table.add({"  that contribute to one value", fmt::format("at most {}", audit.active_leaves)});
    table.add({"largest step at a leaf border", mm(audit.worst_jump_m) + " mm"});
  }
  table.add({"size", fmt::format("{} bytes", audit.bytes)});
  table.left_from = 1;
  return text_of(table) + refusal_sentence(audit.refusals, model.nominal) + "\n";
}

}  // namespace plumb::offline::show
