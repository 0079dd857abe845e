// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "twin/tracker.hpp"

namespace plumb::offline::twin {
namespace {

double mm(double m) { return m * 1e3; }

Json figures_json(const ErrorFigures& figures) {
  return {{"n", figures.n},
          {"mean_mm", mm(figures.mean_m)},
          {"rms_mm", mm(figures.rms_m)},
          {"p95_mm", mm(figures.p95_m)},
          {"max_mm", mm(figures.max_m)}};
}

void add(Json& out, const std::string& key, const TrueErrors& errors) {
  if (errors.truth.n == 0) return put_null(out, key, "not driven");
  out[key] = {{"true", figures_json(errors.truth)}, {"measured", figures_json(errors.measured)}};
}

std::string line(const char* name, const ErrorFigures& figures) {
  if (figures.n == 0) return "";
  return fmt::format("  {:<28} {:>5}  {:.4f}  {:.4f}  {:.4f}  {:.4f}\n", name, figures.n,
                     mm(figures.mean_m), mm(figures.rms_m), mm(figures.p95_m), mm(figures.max_m));
}

}  // namespace

Verdict verdict(const Comparison& c) {
  if (c.on.truth.n == 0)
    return {fmt::format("Without correction the tool misses by {:.3f} mm on average.",
                        mm(c.off.truth.mean_m)),
            "unknown"};
  if (c.off.truth.n == 0)
    return {fmt::format("With correction the tool misses by {:.4f} mm on average.",
                        mm(c.on.truth.mean_m)),
            "unknown"};
  return {fmt::format(
              "{}: correction takes the true error of the tool centre point from {:.3f} to {:.4f} "
              "mm, {:.0f} "
              "times less; the tracker sees {:.2f} times its own noise.",
              c.reached() ? "Good" : "Not good enough", mm(c.off.truth.mean_m),
              mm(c.on.truth.mean_m), c.ratio(), c.on.measured.mean_m / c.floor.mean_m),
          c.reached() ? "good" : "bad"};
}

Json to_json(const Comparison& c) {
  Json out;
  add(out, "off", c.off);
  add(out, "on", c.on);
  out["noise_floor_mm"] = mm(c.floor.mean_m);
  out["noise_floor_rms_mm"] = mm(c.floor.rms_m);
  if (c.ratio() > 0.0) {
    put(out, "ratio", c.ratio());
    put(out, "over_noise", c.on.measured.mean_m / c.floor.mean_m);
    out["reached"] = c.reached();
  }
  out["unsettled"] = c.unsettled;
  return out;
}

std::string to_text(const Comparison& c) {
  std::string out = verdict(c).sentence + "\n\n";
  out += "  true error [mm]              stops    mean     RMS    95 %     max\n";
  out += line("correction off", c.off.truth);
  out += line("correction on", c.on.truth);
  out += line("off, as the tracker sees it", c.off.measured);
  out += line("on, as the tracker sees it", c.on.measured);
  out += fmt::format("  {:<34}  {:.4f}  {:.4f}\n", "the tracker's noise alone", mm(c.floor.mean_m),
                     mm(c.floor.rms_m));
  if (c.unsettled > 0)
    out += fmt::format("  {} stops were read while the correction still moved\n", c.unsettled);
  return out;
}

}  // namespace plumb::offline::twin
