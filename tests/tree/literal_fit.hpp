// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/QR>
#include <cmath>
#include <vector>

#include "tests/runtime/literal_tree.hpp"
#include "tree/samples.hpp"

namespace plumb::offline {

/// The least squares that blended_fit.hpp states, in long double and dense: every leaf at every
/// sample, whether it has a say or not. Shares nothing with the trainer.
class LiteralFit {
 public:
  using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

  /// Where a leaf has a say: weighted mean and deviation of the samples.
  struct Frame {
    Vector middle, scale;
  };

  LiteralFit(const format::Tree& tree, const Samples& u)
      : u_(u.cast<long double>()),
        degree_(tree.degree),
        leaves_(static_cast<Eigen::Index>(tree.leaves())) {
    const test::LiteralTree literal(tree, static_cast<int>(u.cols()));
    phi = Matrix(u.rows(), leaves_);
    for (Eigen::Index i = 0; i < u.rows(); ++i)
      for (Eigen::Index k = 0; k < leaves_; ++k)
        phi(i, k) = literal.validity(static_cast<std::size_t>(k), SampleRow(u, i).span());
    for (Eigen::Index k = 0; k < leaves_; ++k) frames_.push_back(frame(phi.col(k)));
    terms = terms_of(Vector::Zero(u.cols())).size();
    design = Matrix(u.rows(), leaves_ * terms);
    for (Eigen::Index i = 0; i < u.rows(); ++i)
      for (Eigen::Index k = 0; k < leaves_; ++k)
        design.row(i).segment(k * terms, terms) =
            phi(i, k) * terms_of(local(frames_[static_cast<std::size_t>(k)], i)).transpose();
  }

  /// One model for the whole box, in terms of u.
  Vector whole_box(const Vector& y) const {
    Matrix A(u_.rows(), terms);
    for (Eigen::Index i = 0; i < u_.rows(); ++i) A.row(i) = terms_of(u_.row(i).transpose());
    return A.colPivHouseholderQr().solve(y);
  }

  Vector rest(const Vector& y) const {
    const Vector whole = whole_box(y);
    Vector out = y;
    for (Eigen::Index i = 0; i < u_.rows(); ++i)
      out[i] -= terms_of(u_.row(i).transpose()).dot(whole);
    return out;
  }

  long double weight_of(double ridge) const {
    return static_cast<long double>(ridge) * static_cast<long double>(u_.rows()) /
           static_cast<long double>(leaves_);
  }

  /// c of all leaves: the design with sqrt(ridge n / leaves) below it, by Householder.
  Vector solve(const Vector& y, double ridge) const {
    const Eigen::Index n = u_.rows(), m = design.cols();
    Matrix A = Matrix::Zero(n + m, m);
    Vector b = Vector::Zero(n + m);
    A.topRows(n) = design;
    A.bottomRows(m).diagonal().setConstant(std::sqrt(weight_of(ridge)));
    b.head(n) = rest(y);
    return A.colPivHouseholderQr().solve(b);
  }

  /// c of a tree: its coefficients less the whole box's, written in the leaves' frames.
  Vector read(const format::Tree& tree, const Vector& y) const {
    const Vector whole = whole_box(y);
    Vector out(leaves_ * terms);
    for (Eigen::Index k = 0; k < leaves_; ++k) {
      Vector own(terms);
      for (Eigen::Index t = 0; t < terms; ++t)
        own[t] = tree.coefficients[static_cast<std::size_t>(k * terms + t)] - whole[t];
      out.segment(k * terms, terms) = in_frame(own, frames_[static_cast<std::size_t>(k)]);
    }
    return out;
  }

  Matrix phi;     // (n, leaves)
  Matrix design;  // (n, leaves x terms)
  Eigen::Index terms = 0;

 private:
  Frame frame(const Vector& weight) const {
    Frame out{Vector::Zero(u_.cols()), Vector::Zero(u_.cols())};
    for (Eigen::Index k = 0; k < u_.cols(); ++k) {
      out.middle[k] = weight.dot(u_.col(k)) / weight.sum();
      const Vector off = u_.col(k).array() - out.middle[k];
      out.scale[k] = std::sqrt(weight.dot(off.cwiseAbs2()) / weight.sum());
    }
    return out;
  }

  Vector local(const Frame& frame, Eigen::Index i) const {
    return (u_.row(i).transpose() - frame.middle).cwiseQuotient(frame.scale);
  }

  Vector terms_of(const Vector& x) const {
    std::vector<long double> out{1.0L};
    for (long double value : x) out.push_back(value);
    for (Eigen::Index i = 0; degree_ == 2 && i < x.size(); ++i)
      for (Eigen::Index k = i; k < x.size(); ++k) out.push_back(x[i] * x[k]);
    return Eigen::Map<const Vector>(out.data(), static_cast<Eigen::Index>(out.size()));
  }

  /// Taylor's series about the middle: value, slopes and curvatures.
  Vector in_frame(const Vector& w, const Frame& frame) const {
    const Eigen::Index p = u_.cols();
    Vector out = w;
    out[0] = terms_of(frame.middle).dot(w);
    for (Eigen::Index i = 0; i < p; ++i) out[i + 1] = w[i + 1] * frame.scale[i];
    for (Eigen::Index i = 0, next = p + 1; degree_ == 2 && i < p; ++i)
      for (Eigen::Index k = i; k < p; ++k, ++next) {
        out[i + 1] += w[next] * frame.middle[k] * frame.scale[i];
        out[k + 1] += w[next] * frame.middle[i] * frame.scale[k];
        out[next] = w[next] * frame.scale[i] * frame.scale[k];
      }
    return out;
  }

  Matrix u_;
  int degree_;
  Eigen::Index leaves_;
  std::vector<Frame> frames_;
};

}  // namespace plumb::offline
