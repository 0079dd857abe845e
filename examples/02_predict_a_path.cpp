// SPDX-License-Identifier: Apache-2.0
// How far the true arm is from where its controller believes it, along a path in joint space:
// 02_predict_a_path robot.plumb
#include <algorithm>
#include <cstdio>
#include <vector>

#include "examples/model_file.hpp"

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr, "usage: 02_predict_a_path robot.plumb\n");
    return 2;
  }
  const auto loaded = load_or_exit(arguments[1]);
  const plumb::Corrector& corrector = loaded->corrector();
  const auto& joints = loaded->model().nominal.joints;

  constexpr int kPoints = 21;
  double largest_m = 0.0;
  std::printf("%8s %12s  %s\n", "path", "error [mm]", "status");
  for (int k = 0; k < kPoints; ++k) {
    const double along = static_cast<double>(k) / (kPoints - 1);
    std::vector<double> q;
    for (const auto& joint : joints)
      q.push_back(joint.q_min + (0.3 + 0.4 * along) * (joint.q_max - joint.q_min));
    const plumb::Prediction arm = corrector.forward_model().predict(q);
    const double error_m = (arm.X_BT.p - corrector.nominal().forward(q).p).norm();
    largest_m = std::max(largest_m, error_m);
    std::printf("%7.0f%% %12.4f  %s\n", 100.0 * along, 1e3 * error_m, to_string(arm.status));
  }
  std::printf("largest error %.4f mm\n", 1e3 * largest_m);
  return largest_m > 0.0 && largest_m < 0.01 ? 0 : 1;
}
