// SPDX-License-Identifier: Apache-2.0
#include "study/study_row.hpp"

#include <algorithm>
#include <stdexcept>

#include "plumb/runtime/detail/tree.hpp"
#include "tree/domain.hpp"

namespace plumb::offline::study {

Samples values(const AxisTrees& trees, const RowsN& q) {
  const Samples u = normalised(trees.domain, q);
  const std::array views{TreeView(trees.tree[0], 2), TreeView(trees.tree[1], 2)};
  Samples out(q.rows(), 2);
  for (Eigen::Index i = 0; i < q.rows(); ++i) {
    const SampleRow row(u, i);
    out.row(i) << views[0].evaluate(row.span()), views[1].evaluate(row.span());
  }
  return out;
}

const StudyRow& row_of(const std::vector<StudyRow>& rows, const std::string& key) {
  const auto it =
      std::find_if(rows.begin(), rows.end(), [&](const StudyRow& r) { return r.key == key; });
  if (it == rows.end()) throw std::out_of_range("the study has no row " + key);
  return *it;
}

}  // namespace plumb::offline::study
