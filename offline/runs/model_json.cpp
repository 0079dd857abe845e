// SPDX-License-Identifier: Apache-2.0
#include "runs/model_json.hpp"

namespace plumb::format {

using Json = nlohmann::ordered_json;

void to_json(Json& j, const Pose& pose) { j = {{"p", pose.p}, {"q", pose.q}}; }
void from_json(const Json& j, Pose& pose) {
  j.at("p").get_to(pose.p);
  j.at("q").get_to(pose.q);
}

void to_json(Json& j, const Twist& twist) { j = {{"d", twist.d}, {"e", twist.e}}; }
void from_json(const Json& j, Twist& twist) {
  j.at("d").get_to(twist.d);
  j.at("e").get_to(twist.e);
}

void to_json(Json& j, const JointRow& row) {
  j = {{"name", row.name},     {"prismatic", row.type == JointType::kPrismatic},
       {"alpha", row.alpha},   {"a", row.a},
       {"d", row.d},           {"theta", row.theta},
       {"beta", row.beta},     {"scale", row.scale},
       {"offset", row.offset}, {"q_min", row.q_min},
       {"q_max", row.q_max},   {"pre", row.pre},
       {"post", row.post}};
}
void from_json(const Json& j, JointRow& row) {
  j.at("name").get_to(row.name);
  row.type = j.at("prismatic").get<bool>() ? JointType::kPrismatic : JointType::kRevolute;
  j.at("alpha").get_to(row.alpha);
  j.at("a").get_to(row.a);
  j.at("d").get_to(row.d);
  j.at("theta").get_to(row.theta);
  j.at("beta").get_to(row.beta);
  j.at("scale").get_to(row.scale);
  j.at("offset").get_to(row.offset);
  j.at("q_min").get_to(row.q_min);
  j.at("q_max").get_to(row.q_max);
  j.at("pre").get_to(row.pre);
  j.at("post").get_to(row.post);
}

void to_json(Json& j, const JointCoupling& one) {
  j = {{"joint", one.joint}, {"by", one.by}, {"ratio", one.ratio}};
}
void from_json(const Json& j, JointCoupling& one) {
  j.at("joint").get_to(one.joint);
  j.at("by").get_to(one.by);
  j.at("ratio").get_to(one.ratio);
}

void to_json(Json& j, const Chain& chain) {
  j = {{"modified", chain.convention == Convention::kModified},
       {"base", chain.base},
       {"base_twist", chain.base_twist},
       {"joints", chain.joints},
       {"tool_twist", chain.tool_twist},
       {"tool", chain.tool}};
  if (!chain.coupling.empty()) j["coupling"] = chain.coupling;
}
void from_json(const Json& j, Chain& chain) {
  chain.convention = j.at("modified").get<bool>() ? Convention::kModified : Convention::kStandard;
  j.at("base").get_to(chain.base);
  j.at("base_twist").get_to(chain.base_twist);
  j.at("joints").get_to(chain.joints);
  j.at("tool_twist").get_to(chain.tool_twist);
  j.at("tool").get_to(chain.tool);
  if (j.contains("coupling")) j.at("coupling").get_to(chain.coupling);
}

void to_json(Json& j, const Tree& tree) {
  Json nodes = Json::array();
  for (const auto& n : tree.nodes) nodes.push_back({n.threshold, n.input, n.low, n.high});
  j = {{"depth", tree.depth},
       {"nodes", nodes},
       {"coefficients", tree.coefficients},
       {"bounds", tree.bounds},
       {"blend_half_width", tree.blend_half_width},
       {"degree", tree.degree},
       {"directions", tree.directions},
       {"region", tree.region},
       {"sigma", tree.sigma}};
}
void from_json(const Json& j, Tree& tree) {
  j.at("depth").get_to(tree.depth);
  tree.nodes.clear();
  for (const auto& n : j.at("nodes"))
    tree.nodes.push_back({.threshold = n.at(0).get<double>(),
                          .input = n.at(1).get<std::uint16_t>(),
                          .low = n.at(2).get<std::int16_t>(),
                          .high = n.at(3).get<std::int16_t>()});
  j.at("coefficients").get_to(tree.coefficients);
  j.at("bounds").get_to(tree.bounds);
  if (!j.contains("degree")) return;  // trees of earlier versions are crisp and affine
  j.at("blend_half_width").get_to(tree.blend_half_width);
  j.at("degree").get_to(tree.degree);
  j.at("directions").get_to(tree.directions);
  j.at("region").get_to(tree.region);
  j.at("sigma").get_to(tree.sigma);
}

void to_json(Json& j, const ContextRange& range) {
  j = {{"input", static_cast<int>(range.input)},
       {"name", range.name},
       {"low", range.low},
       {"high", range.high}};
}
void from_json(const Json& j, ContextRange& range) {
  range.input = static_cast<ContextInput>(j.at("input").get<int>());
  j.at("name").get_to(range.name);
  j.at("low").get_to(range.low);
  j.at("high").get_to(range.high);
}

void to_json(Json& j, const Domain& domain) {
  j = {{"q_min", domain.q_min}, {"q_max", domain.q_max}, {"fade", domain.fade}};
  if (!domain.context.empty()) j["context"] = domain.context;
}
void from_json(const Json& j, Domain& domain) {
  j.at("q_min").get_to(domain.q_min);
  j.at("q_max").get_to(domain.q_max);
  j.at("fade").get_to(domain.fade);
  if (j.contains("context")) j.at("context").get_to(domain.context);
}

void to_json(Json& j, const ContextNeed& need) {
  j = {{"input", static_cast<int>(need.input)}, {"name", need.name}, {"fallback", need.fallback}};
}
void from_json(const Json& j, ContextNeed& need) {
  need.input = static_cast<ContextInput>(j.at("input").get<int>());
  j.at("name").get_to(need.name);
  j.at("fallback").get_to(need.fallback);
}

void to_json(Json& j, const FormulaParameter& p) {
  j = {{"name", p.name}, {"unit", p.unit}, {"typical", p.typical}, {"start", p.start}};
}
void from_json(const Json& j, FormulaParameter& p) {
  j.at("name").get_to(p.name);
  j.at("unit").get_to(p.unit);
  j.at("typical").get_to(p.typical);
  j.at("start").get_to(p.start);
}

void to_json(Json& j, const Formula& f) {
  j = {{"name", f.name},
       {"target", static_cast<int>(f.target)},
       {"joint", f.joint},
       {"component", f.component},
       {"domain", f.domain},
       {"expression", f.expression},
       {"code", f.code},
       {"literals", f.literals},
       {"parameters", f.parameters}};
}
void from_json(const Json& j, Formula& f) {
  j.at("name").get_to(f.name);
  f.target = static_cast<FormulaTarget>(j.at("target").get<int>());
  j.at("joint").get_to(f.joint);
  j.at("component").get_to(f.component);
  j.at("domain").get_to(f.domain);
  j.at("expression").get_to(f.expression);
  j.at("code").get_to(f.code);
  j.at("literals").get_to(f.literals);
  j.at("parameters").get_to(f.parameters);
}

void to_json(Json& j, const Effect& effect) {
  j = {{"name", effect.name},           {"version", effect.version},
       {"joints", effect.joints},       {"parameters", effect.parameters},
       {"constants", effect.constants}, {"context", effect.context}};
  if (effect.formula != Formula{}) j["formula"] = effect.formula;
}
void from_json(const Json& j, Effect& effect) {
  j.at("name").get_to(effect.name);
  j.at("version").get_to(effect.version);
  j.at("joints").get_to(effect.joints);
  j.at("parameters").get_to(effect.parameters);
  j.at("constants").get_to(effect.constants);
  j.at("context").get_to(effect.context);
  if (j.contains("formula")) j.at("formula").get_to(effect.formula);
}

void to_json(Json& j, const LinkMass& link) { j = {{"kg", link.mass_kg}, {"com_m", link.com_m}}; }
void from_json(const Json& j, LinkMass& link) {
  j.at("kg").get_to(link.mass_kg);
  j.at("com_m").get_to(link.com_m);
}

void to_json(Json& j, const Mechanics& mechanics) {
  j = {{"links", mechanics.links},
       {"payload_kg", mechanics.payload_kg},
       {"payload_com_m", mechanics.payload_com_m}};
}
void from_json(const Json& j, Mechanics& mechanics) {
  j.at("links").get_to(mechanics.links);
  j.at("payload_kg").get_to(mechanics.payload_kg);
  j.at("payload_com_m").get_to(mechanics.payload_com_m);
}

void to_json(Json& j, const InputHash& input) {
  j = {{"file", input.name}, {"sha256", input.sha256}};
}
void from_json(const Json& j, InputHash& input) {
  j.at("file").get_to(input.name);
  j.at("sha256").get_to(input.sha256);
}

}  // namespace plumb::format
