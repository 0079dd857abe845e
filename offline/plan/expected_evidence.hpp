// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "diagnose/evidence.hpp"

namespace plumb::offline {

/// Two laws that are to be told apart, as columns of one matrix Z: the motions of each, for every
/// value of its constants that may be tried, and the readings to be expected if it is the true one.
struct Rivals {
  struct Law {
    struct Variant {
      Eigen::Index first = 0, count = 0;  // columns of Z, scaled so that 1 is a typical size
      double width = 1.0;                 // of the prior of their sizes, in typical sizes
    };
    std::vector<Variant> variants;  // the first one is taken to be true
    Eigen::Index expected = 0;      // column of Z
  };
  Law a, b;
  EvidenceScale scale;     // of the readings made so far
  double fit_share = 1.0;  // of those to come that a diagnosis fits; the others are held out
};

/// By how much the true law is ahead of the wrong one [nats].
struct Leads {
  double if_a = 0.0, if_b = 0.0;
  double least() const { return if_a < if_b ? if_a : if_b; }
};

/// What readings tell about the columns of Z once the geometry is fitted to each of them: their
/// products, orthogonal to the columns G of the geometry, which have a prior of 1 sigma = 1.
class ClearedProducts {
 public:
  ClearedProducts(const Eigen::MatrixXd& G, const Eigen::MatrixXd& Z);

  /// Adds lines G, Z of a reading. Cost: (columns of G)^2 a line.
  void add(const Eigen::MatrixXd& G, const Eigen::MatrixXd& Z);

  /// The products with a reading added, which is not kept.
  Eigen::MatrixXd with(const Eigen::MatrixXd& G, const Eigen::MatrixXd& Z) const;

  const Eigen::MatrixXd& products() const { return products_; }

 private:
  Eigen::MatrixXd covariance_, cross_, products_;
};

/// Expected leads at the products of all readings, of which `further` fitted lines are still to be
/// measured: their noise is added. Quick: at one width of the prior; exactly: as a diagnosis will
/// compute it (diagnose/evidence.hpp).
Leads quick_leads(const Rivals& rivals, const Eigen::MatrixXd& products, double further);
Leads exact_leads(const Rivals& rivals, const Eigen::MatrixXd& products, double further);

/// Chooses n of the candidates so that the smaller of both leads becomes as large as possible:
/// greedily, then one at a time is exchanged for the best other one until nothing improves.
/// G, Z: lines of each candidate, times the root of fit_share; known: what is measured. No
/// candidate is taken twice. Cost: about 10 n (columns of G)^2 a candidate and round, of which
/// there are at most four.
struct Choice {
  std::vector<int> chosen;
  Eigen::MatrixXd products;  // with all of them
  double further = 0.0;      // their fitted lines
};
Choice choose_readings(const Rivals& rivals, const ClearedProducts& known,
                       const std::vector<Eigen::MatrixXd>& G, const std::vector<Eigen::MatrixXd>& Z,
                       int n);

}  // namespace plumb::offline
