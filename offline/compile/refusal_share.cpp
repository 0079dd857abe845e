// SPDX-License-Identifier: Apache-2.0
#include "compile/refusal_share.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cell/random.hpp"
#include "plumb/runtime/corrector.hpp"

namespace plumb::offline {
namespace {

constexpr int kRefusalBands = 12;  // of a joint range
constexpr double kFewestInBand = 20.0, kWellAboveMean = 1.5;

}  // namespace

std::string worst_band_words(std::span<const PoseTried> all, const JointBox& box,
                             const format::Chain& nominal) {
  double mean = 0.0, most = 0.0;
  for (const PoseTried& one : all) mean += one.refused / static_cast<double>(all.size());
  std::string out;
  for (std::size_t j = 0; j < nominal.joints.size(); ++j) {
    const auto& row = nominal.joints[j];
    const bool slides = row.type == format::JointType::kPrismatic;
    const auto [low, high] = box[j];
    const double step = (high - low) / kRefusalBands;
    const double per = slides ? 1e3 : 180.0 / std::numbers::pi;
    for (int k = 0; k < kRefusalBands && step > 0.0; ++k) {
      double n = 0.0, refusals = 0.0;
      for (const PoseTried& one : all) {
        if (one.q[j] < low + k * step || one.q[j] >= low + (k + 1) * step) continue;
        n += 1.0, refusals += one.refused;
      }
      if (n < kFewestInBand || refusals / n < std::max(most, kWellAboveMean * mean)) continue;
      most = refusals / n;
      out = fmt::format(", most of all at {} between {:.0f} and {:.0f} {} ({:.0f} %)", row.name,
                        std::round(per * (low + k * step)) + 0.0,
                        std::round(per * (low + (k + 1) * step)) + 0.0, slides ? "mm" : "deg",
                        100.0 * most);
    }
  }
  return out;
}

RefusalShare refusal_share(const format::Model& model, const JointBox& box) {
  const Corrector corrector(model);
  const Chain& nominal = corrector.nominal();
  Random random(1);
  std::vector<PoseTried> all;
  RefusalShare out;
  out.poses = kRefusalPoses;
  for (int i = 0; i < kRefusalPoses; ++i) {
    PoseTried one;
    for (const auto& [low, high] : box) one.q.push_back(low + random.unit() * (high - low));
    const Status status =
        corrector.solve(nominal.forward(one.q), one.q, SeedKind::kCommanded).status;
    one.refused = refused(status);
    out.refused += one.refused / static_cast<double>(kRefusalPoses);
    const bool singular = status == Status::kNearSingular || status == Status::kOtherConfiguration;
    out.near_singular += singular / static_cast<double>(kRefusalPoses);
    all.push_back(std::move(one));
  }
  out.where = worst_band_words(all, box, model.nominal);
  return out;
}

}  // namespace plumb::offline
