// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace plumb::offline {

/// ln P(F > f) of the F distribution with a and b degrees of freedom, both > 0; 0 for f <= 0.
///
/// P = I_x(b / 2, a / 2) with x = b / (b + a f), by Lentz's continued fraction [Press 2007, 6.4].
/// The logarithm stays finite where P underflows. About 1e-10 relative.
double ln_f_tail(double f, double a, double b);

}  // namespace plumb::offline
