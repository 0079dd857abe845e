// SPDX-License-Identifier: Apache-2.0
#include "compile/refusal_share.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "cell/random.hpp"
#include "plumb/runtime/corrector.hpp"

namespace plumb::offline {
namespace {

// All chosen: the words of a place must help a person to plan poses, no more.
constexpr std::size_t kMostPlaces = 3;
constexpr double kMuchDenser = 5.0;  // times the mean share of refusals makes a place
/// A narrower place is preferred if it holds this share of the refusals of the fullest one.
constexpr double kMostOfAWiderOne = 0.8;
constexpr double kLeastShare = 0.1;  // of the refusals; places with less are not mentioned
constexpr int kBins = 180;           // of half a turn, or of the range of a prismatic joint
constexpr int kCentreStep = 5;       // bins
constexpr std::array<int, 7> kWidths{1, 2, 3, 5, 8, 12, 20};  // bins to either side

bool slides(const format::JointRow& row) { return row.type == format::JointType::kPrismatic; }

/// Joint positions are counted modulo this: half a turn, or the whole travel of a prismatic joint.
double period(const format::JointRow& row) {
  return slides(row) ? row.q_max - row.q_min : std::numbers::pi;
}

/// The distance of q from `at`; of a revolute joint modulo half a turn.
double distance(const format::JointRow& row, double q, double at) {
  const double apart = q - at;
  return std::abs(slides(row) ? apart : std::remainder(apart, std::numbers::pi));
}

struct Bin {
  int refused = 0, all = 0;
};
using Bins = std::array<Bin, kBins>;

Bins counted(std::span<const PoseTried> all, const format::JointRow& row, std::size_t joint) {
  Bins out{};
  for (const PoseTried& one : all) {
    const double x = (one.q[joint] - (slides(row) ? row.q_min : 0.0)) / period(row);
    const double share = slides(row) ? x : x - std::floor(x);
    Bin& bin = out[static_cast<std::size_t>(
        std::clamp<int>(static_cast<int>(share * kBins), 0, kBins - 1))];
    ++bin.all;
    bin.refused += one.refused;
  }
  return out;
}

/// Sums the bins to either side of the lower edge of bin `centre`. With `round` the last bin is
/// next to the first, as positions modulo half a turn are.
Bin around(const Bins& bins, int centre, int width, bool round) {
  Bin out;
  for (int k = centre - width; k < centre + width; ++k) {
    if (!round && (k < 0 || k >= kBins)) continue;
    const Bin& bin = bins[static_cast<std::size_t>((k + kBins) % kBins)];
    out.all += bin.all;
    out.refused += bin.refused;
  }
  return out;
}

/// The fullest place of one width among all joints; share: the number of refusals.
RefusedPlace fullest(std::span<const Bins> joints, const format::Chain& nominal, int width,
                     double mean) {
  RefusedPlace out;
  for (std::size_t j = 0; j < nominal.joints.size(); ++j) {
    const auto& row = nominal.joints[j];
    for (int centre = 0; centre < kBins; centre += kCentreStep) {
      const Bin n = around(joints[j], centre, width, !slides(row));
      if (n.refused <= kMuchDenser * mean * n.all || n.refused <= out.share) continue;
      out = {.joint = j,
             .at = (slides(row) ? row.q_min : 0.0) + period(row) * centre / kBins,
             .within = period(row) * width / kBins,
             .share = static_cast<double>(n.refused)};
    }
  }
  return out;
}

/// The next place among the poses that are in none yet.
RefusedPlace next_place(std::span<const PoseTried> all, const format::Chain& nominal) {
  double refusals = 0.0;
  for (const PoseTried& one : all) refusals += one.refused;
  const double mean = refusals / static_cast<double>(std::max<std::size_t>(all.size(), 1));
  std::vector<Bins> joints;
  for (std::size_t j = 0; j < nominal.joints.size(); ++j)
    joints.push_back(counted(all, nominal.joints[j], j));
  std::vector<RefusedPlace> found;
  double most = 0.0;
  for (const int width : kWidths) {
    found.push_back(fullest(joints, nominal, width, mean));
    most = std::max(most, found.back().share);
  }
  const auto narrow = std::find_if(found.begin(), found.end(), [&](const RefusedPlace& place) {
    return place.share >= kMostOfAWiderOne * most;
  });
  return *narrow;
}

std::string place_words(const RefusedPlace& place, const format::Chain& nominal) {
  const auto& row = nominal.joints[place.joint];
  if (slides(row))
    return fmt::format("{:.1f} % with {} within {:.0f} mm of {:.0f} mm", 100.0 * place.share,
                       row.name, 1e3 * place.within, 1e3 * place.at);
  constexpr double kDeg = 180.0 / std::numbers::pi;
  const double at = std::round(kDeg * place.at);
  return fmt::format("{:.1f} % with {} within {:.0f} deg of {:.0f} or {:.0f} deg",
                     100.0 * place.share, row.name, kDeg * place.within,
                     at == 0.0 ? 0.0 : at - 180.0, at == 0.0 ? 180.0 : at);
}

}  // namespace

std::vector<RefusedPlace> refused_places(std::span<const PoseTried> all,
                                         const format::Chain& nominal) {
  std::vector<PoseTried> rest(all.begin(), all.end());
  const auto total = static_cast<double>(all.size());
  double refusals = 0.0;
  for (const PoseTried& one : all) refusals += one.refused;
  std::vector<RefusedPlace> out;
  while (out.size() < kMostPlaces) {
    RefusedPlace place = next_place(rest, nominal);
    if (place.share <= kLeastShare * refusals) break;
    std::erase_if(rest, [&](const PoseTried& one) {
      return distance(nominal.joints[place.joint], one.q[place.joint], place.at) <= place.within;
    });
    place.share /= total;
    out.push_back(place);
  }
  return out;
}

namespace {

using Range = std::vector<std::pair<double, double>>;  // of each joint

Range joint_limits(const format::Chain& nominal) {
  Range out;
  for (const auto& row : nominal.joints) out.emplace_back(row.q_min, row.q_max);
  return out;
}

/// The range of each joint in the fitted poses; where that is not known, the joint limits.
Range trained_range(const format::Model& model) {
  Range out = joint_limits(model.nominal);
  for (std::size_t j = 0; j < std::min(out.size(), model.domain.q_min.size()); ++j) {
    const double low = std::max(out[j].first, model.domain.q_min[j]);
    const double high = std::min(out[j].second, model.domain.q_max[j]);
    if (low <= high) out[j] = {low, high};
  }
  return out;
}

RefusalShare::Shares tried(const Corrector& corrector, const Range& range,
                           std::vector<PoseTried>& all) {
  Random random(1);
  int refusals = 0, partial = 0;
  for (int i = 0; i < kRefusalPoses; ++i) {
    PoseTried one;
    for (const auto& [low, high] : range) one.q.push_back(low + random.unit() * (high - low));
    const Status status =
        corrector.solve(corrector.nominal().forward(one.q), one.q, SeedKind::kCommanded).status;
    one.refused = refused(status);
    refusals += one.refused;
    partial += status == Status::kPartial;
    all.push_back(std::move(one));
  }
  return {.refused = static_cast<double>(refusals) / kRefusalPoses,
          .partial = static_cast<double>(partial) / kRefusalPoses};
}

std::string partial_words(const char* before, const RefusalShare::Shares& shares) {
  return shares.partial > 0.0
             ? fmt::format("{}{:.1f} % are corrected in part", before, 100.0 * shares.partial)
             : "";
}

}  // namespace

RefusalShare refusal_share(const format::Model& model) {
  const Corrector corrector(model);
  RefusalShare out{.poses = kRefusalPoses, .trained = {}, .limits = {}, .places = {}};
  std::vector<PoseTried> inside, all;
  out.trained = tried(corrector, trained_range(model), inside);
  out.limits = tried(corrector, joint_limits(model.nominal), all);
  out.places = refused_places(all, model.nominal);
  return out;
}

std::string refusal_sentence(const RefusalShare& share, const format::Chain& nominal) {
  std::string out = fmt::format(
      "Of {} random poses in the trained range {:.1f} % are refused{}. Between the joint limits "
      "{:.1f} % are refused",
      share.poses, 100.0 * share.trained.refused, partial_words(", ", share.trained),
      100.0 * share.limits.refused);
  double elsewhere = share.limits.refused;
  for (std::size_t i = 0; i < share.places.size(); ++i) {
    out += (i == 0 ? ": " : ", ") + place_words(share.places[i], nominal);
    elsewhere -= share.places[i].share;
  }
  if (!share.places.empty() && elsewhere > 5e-4)
    out += fmt::format(", {:.1f} % elsewhere", 100.0 * elsewhere);
  return out + partial_words("; ", share.limits) + ".";
}

}  // namespace plumb::offline
