// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace plumb::offline {

/// ln P(F > f) of the F distribution with a and b degrees of freedom, both > 0; 0 for f <= 0.
///
/// P = I_x(b / 2, a / 2) with x = b / (b + a f), by Lentz's continued fraction [Press 2007, 6.4].
/// The logarithm stays finite where P underflows, which libraries do not offer. About 1e-10
/// relative.
double ln_f_tail(double f, double a, double b);

/// The F test of what `numbers` numbers of a model explain against what is left over: the mean
/// squares' ratio, and ln of the probability that it is as large by chance.
struct FTest {
  double ratio = 0.0;
  double ln_p = 0.0;
};
FTest f_test(double explained, double numbers, double left, double free);

/// Standard deviations within which a normal number lies in 95 % of all cases.
inline constexpr double kNormal95 = 1.96;

/// The value that Student's t with `dof` > 0 degrees of freedom exceeds with probability 1 - share.
double student_quantile(double share, double dof);

}  // namespace plumb::offline
