// SPDX-License-Identifier: Apache-2.0
// What somebody's controller does: read a model, correct one pose, guard it.
#include <cstdio>
#include <plumb/format/reader.hpp>
#include <plumb/format/version.hpp>
#include <plumb/format/writer.hpp>
#include <plumb/runtime/corrector.hpp>
#include <plumb/runtime/guard.hpp>

int main() {
  plumb::format::Model model;
  const double alpha[] = {1.5708, 0.0, 0.0, 1.5708, -1.5708, 0.0};
  const double a[] = {0.0, -0.612, -0.5723, 0.0, 0.0, 0.0};
  const double d[] = {0.1273, 0.0, 0.0, 0.1639, 0.1157, 0.0922};
  for (int i = 0; i < 6; ++i) {
    plumb::format::JointRow row;
    row.name = "J" + std::to_string(i + 1);
    row.alpha = alpha[i];
    row.a = a[i];
    row.d = d[i];
    row.q_min = -3.0;
    row.q_max = 3.0;
    model.nominal.joints.push_back(row);
  }
  model.calibrated = model.nominal;
  model.calibrated.joints[1].a += 0.0005;
  const auto read = plumb::format::read_model(plumb::format::write_model(model));
  if (!std::holds_alternative<plumb::format::Model>(read)) return 1;
  const auto& loaded = std::get<plumb::format::Model>(read);

  const plumb::Corrector corrector(loaded);
  plumb::Guard guard(loaded.guard);
  const double q[] = {0.1, -1.2, 1.4, 0.3, 1.1, -0.3};
  const plumb::Transformd target = corrector.nominal().forward(q);
  const auto correction = corrector.solve(target, q, plumb::SeedKind::kCommanded);
  const auto output = guard.step(target, correction, 0.004);
  std::printf("Plumb %s: %s, %.4f mm\n", plumb::format::kVersion, to_string(correction.status),
              (correction.X_BC.p - target.p).norm() * 1e3);
  return refused(correction.status) || !output.has_output ? 1 : 0;
}
