// SPDX-License-Identifier: Apache-2.0
#include "show/artefacts_view.hpp"

#include <fmt/format.h>

#include <optional>

#include "cell/artefacts.hpp"
#include "fit/point_distances.hpp"
#include "show/units.hpp"

namespace plumb::offline::show {
namespace {

ReadingKind kind_of(const MeasurementSettings& m, int setup) {
  return m.setups[static_cast<std::size_t>(setup)].reads;
}

const std::string& name_of(const MeasurementSettings& m, int setup) {
  return m.setups[static_cast<std::size_t>(setup)].name;
}

/// A plane in the base frame: normal * p = offset for every p on it.
struct PlaneB {
  Vector3 normal;
  double offset_m;
};

PlaneB plane_B(const Calibration& c, int setup) {
  const Transformd X_MB = from_pose(c.state.frame(setup));
  return {X_MB.R.row(2).transpose(), -X_MB.p(2)};
}

Json vector_json(const Vector3& v) { return {v(0), v(1), v(2)}; }

Json point_mm(const Vector3& p) { return {to_mm(p(0)), to_mm(p(1)), to_mm(p(2))}; }

void add_points(const Cell& cell, const Calibration& c, Json& out) {
  const MeasurementSettings& m = cell.measurement;
  Json points = Json::array(), distances = Json::array();
  for (int k = 0; k < c.state.setups(); ++k)
    if (of_artefact(m, k) && kind_of(m, k) == ReadingKind::kPoint)
      points.push_back({{"name", name_of(m, k)}, {"position_mm", point_mm(touched_point_B(c, k))}});
  if (points.empty()) return;
  for (const PointDistance& d : point_distances(m, c)) {
    Json one{{"from", name_of(m, d.from)}, {"to", name_of(m, d.to)}};
    put(one, "distance_mm", to_mm(d.length_m));
    put(one, "half_interval_mm", to_mm(d.half_m));
    if (d.stated_m) put(one, "stated_mm", to_mm(*d.stated_m));
    distances.push_back(std::move(one));
  }
  out["points"] = {{"touched", std::move(points)},
                   {"distances", std::move(distances)},
                   {"size_known", !lacks_length(cell)}};
}

Json artefact_json(const MeasurementSettings& m, const Calibration& c, int k) {
  const Setup& rule = m.setups[static_cast<std::size_t>(k)];
  Json one{{"name", rule.name}, {"kind", descriptor_of(rule.reads).noun}};
  if (is_of_plane(rule.reads)) {
    const PlaneB plane = plane_B(c, k);
    one["normal"] = vector_json(plane.normal);
    put(one, "offset_mm", to_mm(plane.offset_m));
    return one;
  }
  one["position_mm"] = point_mm(touched_point_B(c, k));
  if (rule.reads == ReadingKind::kSphere || rule.fit_length) {
    put(one, "length_mm", to_mm(c.state.length(k)));
    one["length_fitted"] = rule.fit_length;
  }
  return one;
}

Table points_table(const MeasurementSettings& m, const Calibration& c) {
  Table table{.name = "points",
              .caption = "Where the touched points are",
              .head = {"point [mm]", "x", "y", "z"}};
  for (int k = 0; k < c.state.setups(); ++k) {
    if (!of_artefact(m, k) || kind_of(m, k) != ReadingKind::kPoint) continue;
    const Vector3 p = touched_point_B(c, k);
    table.add({name_of(m, k), mm(p(0)), mm(p(1)), mm(p(2))});
  }
  return table;
}

Table planes_table(const MeasurementSettings& m, const Calibration& c) {
  Table table{.name = "planes",
              .caption = "Where the planes are",
              .head = {"plane", "normal x", "y", "z", "from the base [mm]"}};
  const auto share = [](double v) { return fmt::format("{:.6f}", v); };
  for (int k = 0; k < c.state.setups(); ++k) {
    if (!of_artefact(m, k) || !is_of_plane(kind_of(m, k))) continue;
    const PlaneB plane = plane_B(c, k);
    table.add({name_of(m, k), share(plane.normal(0)), share(plane.normal(1)),
               share(plane.normal(2)), mm(plane.offset_m)});
  }
  return table;
}

Table centres_table(const MeasurementSettings& m, const Calibration& c) {
  Table table{.name = "centres",
              .caption = "Where spheres and anchors are",
              .head = {"centre [mm]", "x", "y", "z", "radius, or zero of the wire"}};
  for (int k = 0; k < c.state.setups(); ++k) {
    if (!of_artefact(m, k) || !descriptor_of(kind_of(m, k)).radial) continue;
    const Setup& rule = m.setups[static_cast<std::size_t>(k)];
    const Vector3 p = touched_point_B(c, k);
    const bool has_length = rule.fit_length || rule.reads == ReadingKind::kSphere;
    table.add({rule.name, mm(p(0)), mm(p(1)), mm(p(2)),
               has_length ? mm(c.state.length(k)) + (rule.fit_length ? "" : " stated") : ""});
  }
  return table;
}

std::optional<int> first_artefact(const MeasurementSettings& m, const Calibration& c) {
  for (int k = 0; k < c.state.setups(); ++k)
    if (of_artefact(m, k)) return k;
  return std::nullopt;
}

}  // namespace

void add_artefacts(const Cell& cell, const Calibration& c, Json& out) {
  add_points(cell, c, out);
  const MeasurementSettings& m = cell.measurement;
  Json others = Json::array();
  for (int k = 0; k < c.state.setups(); ++k)
    if (of_artefact(m, k) && kind_of(m, k) != ReadingKind::kPoint)
      others.push_back(artefact_json(m, c, k));
  if (others.empty()) return;
  out["artefacts"] = {{"found", std::move(others)}, {"size_known", !lacks_length(cell)}};
}

Blocks artefacts_blocks(const Cell& cell, const Calibration& c) {
  const MeasurementSettings& m = cell.measurement;
  const auto first = first_artefact(m, c);
  if (!first) return {};
  Blocks out;
  for (Table& table : std::vector{points_table(m, c), planes_table(m, c), centres_table(m, c)})
    if (!table.rows.empty()) out.push_back(std::move(table));
  const auto& t = c.state.target(*first).p;
  out.push_back(under(fmt::format(
      "in the base frame; the tool touches them with its point ({:.3f}, {:.3f}, {:.3f}) mm",
      to_mm(t[0]), to_mm(t[1]), to_mm(t[2]))));
  for (const PointDistance& distance : point_distances(m, c))
    out.push_back(under(distance_words(m, distance)));
  if (lacks_length(cell))
    out.push_back(
        under("no length is known: these readings tell the shape of the arm and hardly its size; "
              "one length "
              "would settle it, as the known distance of two touched points (columns to_point and "
              "distance_mm) or the radius of a sphere (radius_mm)"));
  return out;
}

}  // namespace plumb::offline::show
