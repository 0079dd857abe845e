// SPDX-License-Identifier: Apache-2.0
#include "compile/c_tree_code.hpp"

namespace plumb::offline {

std::string_view c_tree_types() {
  return R"(/* Goes low where u[input], or direction . u, <= threshold. A child < 0 is leaf -1 - child. */
typedef struct {
  double threshold;
  short input, low, high;
} @_node;

/* How the domain is cut into leaves: leaves - 1 nodes, as many half widths (none: crisp), and for
 * each node a direction (none: along the joints). */
typedef struct {
  const @_node *nodes;
  const double *half_width;
  const double *direction;
  int leaves;
} @_shape;

/* What the leaves say of one axis; shape -1: nothing. Leaf by leaf: coefficients [m] of
 * (1, u_i [, u_i u_k for i <= k]), bounds (low, high) [m], region (low, high) of each joint. */
typedef struct {
  int shape, terms;
  const double *coefficient;
  const double *bound;
  const double *region;
} @_tree;

)";
}

std::string_view c_tree_functions() {
  return R"(/* Leaves, or nodes, that have a say, and how much. */
typedef struct {
  int count;
  int index[@_room];
  double weight[@_room];
} @_list;

/* Written so that NaN gives low. */
static inline double @_clamp(double x, double low, double high) {
  return x > low ? (x < high ? x : high) : low;
}

static inline double @_split_value(const @_shape *shape, const double *u, int node) {
  if (!shape->direction) return u[shape->nodes[node].input];
  const double *d = shape->direction + node * @_joints;
  double sum = u[0] * d[0];
  for (int i = 1; i < @_joints; ++i) sum = sum + u[i] * d[i];
  return sum;
}

static inline int @_hard_leaf(const @_shape *shape, const double *u) {
  int at = shape->leaves > 1 ? 0 : -1;
  while (at >= 0) {
    const @_node *node = &shape->nodes[at];
    at = @_split_value(shape, u, at) <= node->threshold ? node->low : node->high;
  }
  return -1 - at;
}

/* Depth first. A side that a ramp leaves less than rounding of the weight has no say. Where more
 * than @_room would have one, further nodes are crisp. */
static inline void @_walk(const @_shape *shape, const double *u, @_list *leaves) {
  @_list open;
  int at = shape->leaves > 1 ? 0 : -1;
  double weight = 1.0;
  open.count = 0;
  for (;;) {
    while (at >= 0) {
      const @_node *node = &shape->nodes[at];
      const double h = shape->half_width[at], width = 2.0 * h;
      const double into = @_split_value(shape, u, at) - (node->threshold - h);
      int says_low = into < width * (1.0 - @_ramp_end), says_high = into > width * @_ramp_end;
      if (leaves->count + open.count + 1 >= @_room) {
        says_high = into > 0.5 * width;
        says_low = !says_high;
      }
      if (says_low && says_high) {
        const double s = into / width, high = weight * (s * s * (3.0 - 2.0 * s));
        open.index[open.count] = node->high;
        open.weight[open.count++] = high;
        weight = weight - high;
        at = node->low;
      } else {
        at = says_high ? node->high : node->low;
      }
    }
    leaves->index[leaves->count] = -1 - at;
    leaves->weight[leaves->count++] = weight;
    if (open.count == 0) return;
    at = open.index[--open.count];
    weight = open.weight[open.count];
  }
}

static inline void @_find_leaves(const @_shape *shape, const double *u, @_list *leaves) {
  leaves->count = 0;
  if (shape->half_width) {
    @_walk(shape, u, leaves);
    return;
  }
  leaves->count = 1;
  leaves->index[0] = @_hard_leaf(shape, u);
  leaves->weight[0] = 1.0;
}

/* Product over the joints of 3 s^2 - 2 s^3, s falling from 1 to 0 outside the leaf's region. */
static inline double @_trust(const double *region, const double *u) {
  double out = 1.0;
  for (int i = 0; i < @_joints; ++i) {
    const double low = region[2 * i], high = region[2 * i + 1];
    const double excess = u[i] > high ? u[i] - high : u[i] < low ? low - u[i] : 0.0;
    const double s = excess < @_region_fade ? 1.0 - excess / @_region_fade : 0.0;
    out = out * (s * s * (3.0 - 2.0 * s));
  }
  return out;
}

/* Identity in low .. high; beyond it t -> m t / (m + t), m a share of the range. */
static inline double @_hold_softly(double y, double low, double high) {
  const double m = (high - low) * @_soft_share;
  if (y > high) return high + m * (y - high) / (m + (y - high));
  if (y < low) return low - m * (low - y) / (m + (low - y));
  return y;
}

static inline void @_fill_terms(const double *u, double *term) {
  int next = 0;
  term[next++] = 1.0;
  for (int i = 0; i < @_joints; ++i) term[next++] = u[i];
  if (@_terms == 1 + @_joints) return;
  for (int i = 0; i < @_joints; ++i)
    for (int k = i; k < @_joints; ++k) term[next++] = u[i] * u[k];
}

static inline double @_evaluate(
    const @_tree *tree, const double *u, const double *term, const @_list *leaves, int blended) {
  double y = 0.0, low = 0.0, high = 0.0, trusted = tree->region ? 0.0 : 1.0;
  for (int i = 0; i < leaves->count; ++i) {
    const int k = leaves->index[i];
    const double weight = leaves->weight[i];
    const double *w = tree->coefficient + k * tree->terms;
    double value = w[0];
    for (int t = 1; t < tree->terms; ++t) value = value + term[t] * w[t];
    y = y + weight * value;
    low = low + weight * tree->bound[2 * k];
    high = high + weight * tree->bound[2 * k + 1];
    if (tree->region)
      trusted = trusted + weight * @_trust(tree->region + k * @_joints * 2, u);
  }
  return (blended ? @_hold_softly(y, low, high) : @_clamp(y, low, high)) * trusted;
}

)";
}

std::string_view c_tree_error() {
  return R"(static inline int @_tree_error(const double q[@_joints], double error_m[3]) {
  double u[@_joints], term[@_terms];
  double excess = 0.0;
  error_m[0] = error_m[1] = error_m[2] = 0.0;
  for (int i = 0; i < @_joints; ++i)
    if (!(q[i] >= -@_max_position && q[i] <= @_max_position)) return -1;
  for (int i = 0; i < @_joints; ++i) {
    const double x = (q[i] - @_middle[i]) * @_half_inverse[i];
    const double beyond = x - 1.0 < -1.0 - x ? -1.0 - x : x - 1.0;
    excess = excess < beyond ? beyond : excess;
    u[i] = @_clamp(x, -1.0, 1.0);
  }
  const double weight = @_clamp(1.0 - excess * @_fade_inverse, 0.0, 1.0);
  @_fill_terms(u, term);
  for (int s = 0; s < @_shape_count; ++s) {
    const @_shape *shape = &@_shapes[s];
    @_list leaves;
    @_find_leaves(shape, u, &leaves);
    for (int axis = 0; axis < 3; ++axis) {
      const @_tree *tree = &@_trees[axis];
      if (tree->shape == s)
        error_m[axis] = @_evaluate(tree, u, term, &leaves, shape->half_width != 0) * weight;
    }
  }
  return weight < 1.0 ? 1 : 0;
}
)";
}

}  // namespace plumb::offline
