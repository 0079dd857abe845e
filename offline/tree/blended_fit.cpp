// SPDX-License-Identifier: Apache-2.0
#include "tree/blended_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "numbers/cholesky.hpp"
#include "numbers/jobs.hpp"
#include "plumb/runtime/detail/tree.hpp"

namespace plumb::offline {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;

constexpr int kDenseUnknowns = 900;   // more are solved with sparse matrices
constexpr Index kSlab = 256;          // rows that are added to the normal equations at once
constexpr double kLeastScale = 1e-6;  // smallest scale of a leaf, in normalised inputs
constexpr double kRootRidge = 1e-12;  // ridge of the model for the whole box

/// The weights of the leaves at every sample, listed by sample and again by leaf.
struct Say {
  struct Entry {
    int index;  // of the leaf, or of the row
    double weight;
  };
  std::vector<std::size_t> row_begin;
  std::vector<Entry> by_row;
  std::vector<std::vector<Entry>> by_leaf;
};

Say say_of(const format::Tree& tree, const Samples& u) {
  const TreeView view(tree, static_cast<int>(u.cols()));
  Say out;
  out.by_leaf.resize(tree.leaves());
  out.row_begin.push_back(0);
  ActiveLeaves<double> active;
  for (Index i = 0; i < u.rows(); ++i) {
    view.active(SampleRow(u, i).span(), active);
    for (int k = 0; k < active.count; ++k) {
      out.by_row.push_back({active.leaf[k], active.weight[k]});
      out.by_leaf[active.leaf[k]].push_back({static_cast<int>(i), active.weight[k]});
    }
    out.row_begin.push_back(out.by_row.size());
  }
  return out;
}

/// The share of the range seen in n samples by which the true values may exceed that range between
/// and beside the samples. It is about the distance of neighbours in a grid over two inputs, and a
/// quarter for few samples.
double unseen_share(std::size_t n) {
  return n == 0 ? 0.0 : std::min(0.25, 2.0 / std::sqrt(static_cast<double>(n)));
}

/// The centre and the scale of the inputs in the region where a leaf is active.
struct Frame {
  std::array<double, format::kMaxJoints> middle{}, scale{};
};

Frame frame_of(const std::vector<Say::Entry>& entries, const Samples& u) {
  Frame out;
  double total = 0.0;
  for (const auto& e : entries) total += e.weight;
  for (Index k = 0; k < u.cols(); ++k) {
    double sum = 0.0, squares = 0.0;
    for (const auto& e : entries) sum += e.weight * u(e.index, k);
    const double middle = total > 0.0 ? sum / total : 0.0;
    for (const auto& e : entries)
      squares += e.weight * (u(e.index, k) - middle) * (u(e.index, k) - middle);
    out.middle[k] = middle;
    out.scale[k] = std::max(kLeastScale, total > 0.0 ? std::sqrt(squares / total) : 0.0);
  }
  return out;
}

/// Converts the coefficients w of (u - middle) / scale to coefficients of u.
void to_inputs(const Frame& frame, int inputs, int degree, const double* w, double* out) {
  const std::size_t terms = format::leaf_terms(static_cast<std::size_t>(inputs), degree);
  std::fill_n(out, terms, 0.0);
  out[0] = w[0];
  const auto linear = [&](int k, double slope) {
    out[k + 1] += slope;
    out[0] -= slope * frame.middle[k];
  };
  for (int k = 0; k < inputs; ++k) linear(k, w[k + 1] / frame.scale[k]);
  if (degree < 2) return;
  std::size_t next = static_cast<std::size_t>(inputs) + 1;
  for (int i = 0; i < inputs; ++i)
    for (int k = i; k < inputs; ++k, ++next) {
      const double c = w[next] / (frame.scale[i] * frame.scale[k]);
      out[next] += c;
      // (u_i - m_i)(u_k - m_k) = u_i u_k - m_i u_k - m_k u_i + m_i m_k
      out[k + 1] -= c * frame.middle[i];
      out[i + 1] -= c * frame.middle[k];
      out[0] += c * frame.middle[i] * frame.middle[k];
    }
}

}  // namespace

struct BlendedFit::Design {
  Design(const format::Tree& t, const Samples& samples)
      : tree(t),
        u(samples),
        say(say_of(t, samples)),
        inputs(static_cast<int>(samples.cols())),
        terms(static_cast<int>(format::leaf_terms(samples.cols(), t.degree))),
        leaves(static_cast<int>(t.leaves())) {
    for (const auto& entries : say.by_leaf) frames.push_back(frame_of(entries, u));
    if (leaves * terms <= kDenseUnknowns)
      set_up_dense();
    else
      set_up_sparse();
  }

  /// The terms of a leaf at row i in its own centred inputs, multiplied by its weight.
  void fill(const Frame& frame, Index i, double weight, double* out) const {
    std::array<double, format::kMaxJoints> local;
    for (int j = 0; j < inputs; ++j) local[j] = (u(i, j) - frame.middle[j]) / frame.scale[j];
    fill_leaf_terms<double>({local.data(), static_cast<std::size_t>(inputs)}, tree.degree,
                            {out, static_cast<std::size_t>(terms)});
    for (int t = 0; t < terms; ++t) out[t] *= weight;
  }

  /// The weighted terms of every active leaf at every sample, row by row.
  std::vector<double> all_terms() const {
    std::vector<double> out(say.by_row.size() * terms);
    for (Index i = 0; i < u.rows(); ++i)
      for (std::size_t e = say.row_begin[i]; e < say.row_begin[i + 1]; ++e)
        fill(frames[say.by_row[e].index], i, say.by_row[e].weight, &out[e * terms]);
    return out;
  }

  /// Sets up the dense normal matrix from slabs of rows, so that most of the work is matrix
  /// products.
  void set_up_dense() {
    phi = all_terms();
    dense = MatrixXd::Zero(unknowns(), unknowns());
    for (Index begin = 0; begin < u.rows(); begin += kSlab) {
      const Index rows = std::min<Index>(kSlab, u.rows() - begin);
      MatrixXd slab = MatrixXd::Zero(unknowns(), rows);
      for (Index i = 0; i < rows; ++i)
        for (std::size_t e = say.row_begin[begin + i]; e < say.row_begin[begin + i + 1]; ++e)
          slab.col(i).segment(say.by_row[e].index * terms, terms) =
              Eigen::Map<const VectorXd>(&phi[e * terms], terms);
      dense.selfadjointView<Eigen::Lower>().rankUpdate(slab);
    }
  }

  /// Sets up the sparse normal matrix by blocks of columns, so that no two jobs write the same
  /// numbers.
  void set_up_sparse() {
    phi = all_terms();
    const std::size_t block = static_cast<std::size_t>(terms) * terms;
    struct Column {
      std::vector<int> leaf;
      std::vector<double> values;
    };
    std::vector<Column> columns(leaves);
    constexpr int kJobs = 64;
    run_jobs(kJobs, [&](int job) {
      std::vector<double> sums(block * leaves);
      std::vector<char> met(leaves, 0);
      for (int l = job; l < leaves; l += kJobs) {
        Column& column = columns[l];
        for (const auto& entry : say.by_leaf[l]) add_row(entry.index, l, sums, met, column.leaf);
        std::sort(column.leaf.begin(), column.leaf.end());
        for (int k : column.leaf) {
          double* from = &sums[k * block];
          column.values.insert(column.values.end(), from, from + block);
          std::fill_n(from, block, 0.0);
          met[k] = 0;
        }
      }
    });
    std::vector<int> reserve(unknowns());
    for (int l = 0; l < leaves; ++l)
      for (int t = 0; t < terms; ++t)
        reserve[l * terms + t] = static_cast<int>(columns[l].leaf.size()) * terms;
    sparse.resize(unknowns(), unknowns());
    sparse.reserve(reserve);
    for (int l = 0; l < leaves; ++l)
      for (int t = 0; t < terms; ++t)
        for (std::size_t b = 0; b < columns[l].leaf.size(); ++b)
          for (int s = 0; s < terms; ++s) {
            const int row = columns[l].leaf[b] * terms + s;
            if (row >= l * terms + t)
              sparse.insert(row, l * terms + t) = columns[l].values[b * block + s * terms + t];
          }
    sparse.makeCompressed();
  }

  void add_row(int row, int l, std::vector<double>& sums, std::vector<char>& met,
               std::vector<int>& list) const {
    const std::size_t begin = say.row_begin[row], end = say.row_begin[row + 1];
    std::size_t own = begin;
    while (say.by_row[own].index != l) ++own;
    const double* a = &phi[own * terms];
    for (std::size_t e = begin; e < end; ++e) {
      const int k = say.by_row[e].index;
      if (k < l) continue;
      if (!met[k]) {
        met[k] = 1;
        list.push_back(k);
      }
      const double* b = &phi[e * terms];
      double* sum = &sums[static_cast<std::size_t>(k) * terms * terms];
      for (int s = 0; s < terms; ++s)
        for (int t = 0; t < terms; ++t) sum[s * terms + t] += b[s] * a[t];
    }
  }

  int unknowns() const { return leaves * terms; }

  /// Fits one model for the whole box. Shape (terms, outputs).
  MatrixXd whole_box(const Samples& y) const {
    std::vector<Say::Entry> all(u.rows());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = {static_cast<int>(i), 1.0};
    const Frame frame = frame_of(all, u);
    MatrixXd A = MatrixXd::Zero(terms, terms), b = MatrixXd::Zero(terms, y.cols());
    VectorXd x(terms);
    for (Index i = 0; i < u.rows(); ++i) {
      fill(frame, i, 1.0, x.data());
      A += x * x.transpose();
      b += x * y.row(i);
    }
    A.diagonal().array() += kRootRidge * static_cast<double>(u.rows());
    const MatrixXd local = SymmetricSolver(A).solve(b);
    MatrixXd out(terms, y.cols());
    for (Index k = 0; k < y.cols(); ++k)
      to_inputs(frame, inputs, tree.degree, local.col(k).data(), out.col(k).data());
    return out;
  }

  Samples less(const Samples& y, const MatrixXd& whole) const {
    Samples out = y;
    VectorXd x(terms);
    for (Index i = 0; i < u.rows(); ++i) {
      fill_leaf_terms<double>(SampleRow(u, i).span(), tree.degree,
                              {x.data(), static_cast<std::size_t>(terms)});
      out.row(i) -= x.transpose() * whole;
    }
    return out;
  }

  MatrixXd right_side(const Samples& y) const {
    MatrixXd out = MatrixXd::Zero(unknowns(), y.cols());
    for (Index i = 0; i < u.rows(); ++i)
      for (std::size_t e = say.row_begin[i]; e < say.row_begin[i + 1]; ++e) {
        const Eigen::Map<const VectorXd> x(&phi[e * terms], terms);
        out.middleRows(say.by_row[e].index * terms, terms) += x * y.row(i);
      }
    return out;
  }

  MatrixXd solve(const MatrixXd& b, double ridge) const {
    const double added = std::max(ridge, kLeastRidge) * static_cast<double>(u.rows()) / leaves;
    if (dense.size() > 0) {
      MatrixXd A = dense;
      A.diagonal().array() += added;
      const Cholesky factor(A);  // reads the lower triangle
      if (factor.exists()) return factor.solve(b);
      return SymmetricSolver(A).solve(b);
    }
    Sparse A = sparse;
    for (int k = 0; k < unknowns(); ++k) A.coeffRef(k, k) += added;
    Eigen::SimplicialLDLT<Sparse, Eigen::Lower> factor(A);
    return factor.solve(b);
  }

  format::Tree with(const MatrixXd& c, const MatrixXd& whole, const Samples& y,
                    Index output) const {
    format::Tree out = tree;
    out.coefficients.assign(static_cast<std::size_t>(unknowns()), 0.0);
    out.bounds.assign(2 * static_cast<std::size_t>(leaves), 0.0);
    for (int k = 0; k < leaves; ++k) {
      double* w = &out.coefficients[static_cast<std::size_t>(k) * terms];
      const VectorXd own = c.col(output).segment(k * terms, terms);
      to_inputs(frames[k], inputs, tree.degree, own.data(), w);
      for (int t = 0; t < terms; ++t) w[t] += whole(t, output);
      double low = say.by_leaf[k].empty() ? 0.0 : y(say.by_leaf[k][0].index, output), high = low;
      for (const auto& entry : say.by_leaf[k]) {
        low = std::min(low, y(entry.index, output));
        high = std::max(high, y(entry.index, output));
      }
      const double beyond = unseen_share(say.by_leaf[k].size()) * (high - low);
      out.bounds[2 * k] = low - beyond;
      out.bounds[2 * k + 1] = high + beyond;
    }
    return out;
  }

  format::Tree tree;
  const Samples& u;
  Say say;
  int inputs, terms, leaves;
  std::vector<Frame> frames;
  std::vector<double> phi;
  MatrixXd dense;  // lower triangle, or empty if `sparse` is used
  Sparse sparse;
};

BlendedFit::BlendedFit(const format::Tree& tree, const Samples& u)
    : design_(std::make_unique<Design>(tree, u)) {}
BlendedFit::~BlendedFit() = default;

int BlendedFit::unknowns() const { return design_->unknowns(); }

std::vector<format::Tree> BlendedFit::solve(const Samples& y, double ridge) const {
  const MatrixXd whole = design_->whole_box(y);
  const MatrixXd c = design_->solve(design_->right_side(design_->less(y, whole)), ridge);
  std::vector<format::Tree> out;
  for (Index k = 0; k < y.cols(); ++k) out.push_back(design_->with(c, whole, y, k));
  return out;
}

std::vector<format::Tree> BlendedFit::solve_locally(const Samples& y) const {
  const Design& d = *design_;
  MatrixXd c = MatrixXd::Zero(d.unknowns(), y.cols());
  for (int k = 0; k < d.leaves; ++k) {
    MatrixXd A = MatrixXd::Zero(d.terms, d.terms), b = MatrixXd::Zero(d.terms, y.cols());
    VectorXd x(d.terms);
    for (const auto& entry : d.say.by_leaf[k]) {
      d.fill(d.frames[k], entry.index, std::sqrt(entry.weight), x.data());
      A += x * x.transpose();
      b += x * (std::sqrt(entry.weight) * y.row(entry.index));
    }
    A.diagonal().array() += kRootRidge * std::max(1.0, A.trace());
    c.middleRows(k * d.terms, d.terms) = SymmetricSolver(A).solve(b);
  }
  const MatrixXd nothing = MatrixXd::Zero(d.terms, y.cols());
  std::vector<format::Tree> out;
  for (Index k = 0; k < y.cols(); ++k) out.push_back(d.with(c, nothing, y, k));
  return out;
}

}  // namespace plumb::offline
