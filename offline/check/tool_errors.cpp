// SPDX-License-Identifier: Apache-2.0
#include "check/tool_errors.hpp"

#include "arm/predicted_points.hpp"

namespace plumb::offline {

Rows3 errors_in_tool(const ArmState& state, const Measurements& some, const Rows3& errors_M) {
  const Rows3 errors_B = to_base(state, some, errors_M);
  const Chain chain(state.arm.calibrated);
  ChainFrames frames;
  Rows3 out(errors_M.rows(), 3);
  for (Eigen::Index i = 0; i < errors_M.rows(); ++i) {
    const auto q = some.q.row(i);
    chain.frames({q.data(), static_cast<std::size_t>(q.cols())}, frames);
    out.row(i) = (frames.tip.R.transpose() * errors_B.row(i).transpose()).transpose();
  }
  return out;
}

}  // namespace plumb::offline
