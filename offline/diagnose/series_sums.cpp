// SPDX-License-Identifier: Apache-2.0
#include "diagnose/series_sums.hpp"

#include <algorithm>

#include "fit/series_numbers.hpp"

namespace plumb::offline {

Eigen::MatrixXd waves_of_joint(const WhitenedFit& s, int joint, int count) {
  Eigen::VectorXd q(s.poses());
  for (Eigen::Index i = 0; i < s.poses(); ++i) q(i) = s.q(i)[joint];
  return series_waves(q, count);
}

SeriesProducts SeriesProducts::of(const std::vector<int>& some) const {
  SeriesProducts out{.joints = some, .waves = waves, .folds = {}, .all = {}};
  std::vector<Eigen::Index> index;
  for (const int joint : some) {
    const auto place = std::find(joints.begin(), joints.end(), joint) - joints.begin();
    for (Eigen::Index c = 0; c < 2 * waves; ++c) index.push_back(place * 2 * waves + c);
  }
  const auto part = [&](const Products& p) {
    return Products{p.XX(index, index), p.UX(Eigen::all, index), p.Xy(index)};
  };
  for (const Products& fold : folds) out.folds.push_back(part(fold));
  out.all = part(all);
  return out;
}

const SeriesSums::OfJoint& SeriesSums::of_joint(int joint) {
  const auto [at, fresh] = joints_.try_emplace(joint);
  OfJoint& out = at->second;
  if (!fresh) return out;
  out.waves = waves_of_joint(whitened_, joint, 2 * waves_);
  const auto place = static_cast<std::size_t>(joint);
  for (const Segment& fold : whitened_.folds) {
    const auto block = out.waves.middleRows(fold.begin, fold.size());
    out.UX.emplace_back(whitened_.joint_U[place].middleRows(fold.begin, fold.size()).transpose() *
                        block);
    out.Xy.emplace_back(block.transpose() *
                        whitened_.joint_y[place].segment(fold.begin, fold.size()));
  }
  return out;
}

const std::vector<Eigen::MatrixXd>& SeriesSums::of_pair(int a, int b) {
  const auto [at, fresh] = pairs_.try_emplace({a, b});
  std::vector<Eigen::MatrixXd>& out = at->second;
  if (!fresh) return out;
  const Eigen::MatrixXd &first = of_joint(a).waves, &second = of_joint(b).waves;
  // Summed over the lines of each pose.
  const Eigen::VectorXd both = whitened_.joint[static_cast<std::size_t>(a)]
                                   .cwiseProduct(whitened_.joint[static_cast<std::size_t>(b)])
                                   .reshaped(whitened_.axes, whitened_.poses())
                                   .colwise()
                                   .sum();
  for (const Segment& fold : whitened_.folds) {
    const Eigen::MatrixXd weighed = both.segment(fold.begin, fold.size()).asDiagonal() *
                                    second.middleRows(fold.begin, fold.size());
    out.emplace_back(first.middleRows(fold.begin, fold.size()).transpose() * weighed);
  }
  return out;
}

SeriesProducts SeriesSums::of(const std::vector<int>& joints) {
  SeriesProducts out{.joints = joints, .waves = waves_, .folds = {}, .all = {}};
  const Eigen::Index each = 2 * waves_, count = each * static_cast<Eigen::Index>(joints.size());
  for (std::size_t f = 0; f < whitened_.folds.size(); ++f) {
    Products fold{Eigen::MatrixXd(count, count), Eigen::MatrixXd(whitened_.rank, count),
                  Eigen::VectorXd(count)};
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i) * each;
      fold.UX.middleCols(at, each) = of_joint(joints[i]).UX[f];
      fold.Xy.segment(at, each) = of_joint(joints[i]).Xy[f];
      for (std::size_t k = 0; k <= i; ++k) {
        const Eigen::MatrixXd& block = of_pair(joints[k], joints[i])[f];
        fold.XX.block(static_cast<Eigen::Index>(k) * each, at, each, each) = block;
        fold.XX.block(at, static_cast<Eigen::Index>(k) * each, each, each) = block.transpose();
      }
    }
    out.folds.push_back(std::move(fold));
  }
  out.all = sum_of(out.folds);
  return out;
}

}  // namespace plumb::offline
