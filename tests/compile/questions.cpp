// SPDX-License-Identifier: Apache-2.0
#include "questions.hpp"

#include <cmath>
#include <limits>

namespace plumb::tests {
namespace {

using Limits = std::numeric_limits<double>;

double somewhere(const format::Domain& domain, std::size_t i, Random& random) {
  return random.uniform(domain.q_min[i], domain.q_max[i]);
}

double at_border(const format::Domain& domain, std::size_t i, Random& random) {
  const double x = random.below(2) == 0 ? domain.q_min[i] : domain.q_max[i];
  const double towards[] = {-Limits::infinity(), x, Limits::infinity()};
  return std::nextafter(x, towards[random.below(3)]);
}

double outside(const format::Domain& domain, std::size_t i, Random& random) {
  const double span = domain.q_max[i] - domain.q_min[i];
  const double by = span * (random.below(2) == 0 ? domain.fade : 4.0) * random.uniform(0.0, 1.0);
  return random.below(2) == 0 ? domain.q_min[i] - by : domain.q_max[i] + by;
}

Question middle(const format::Domain& domain) {
  Question out;
  for (std::size_t i = 0; i < domain.q_min.size(); ++i)
    out.push_back(0.5 * (domain.q_min[i] + domain.q_max[i]));
  return out;
}

}  // namespace

std::vector<Question> questions(const format::Model& model, int count, Random& random) {
  const format::Domain& domain = model.domain;
  std::vector<Question> out;
  for (int n = 0; n < count; ++n) {
    Question q;
    for (std::size_t i = 0; i < domain.q_min.size(); ++i) q.push_back(somewhere(domain, i, random));
    const auto joint = static_cast<std::size_t>(random.below(static_cast<int>(q.size())));
    const int what = random.below(10);
    if (what == 0) q[joint] = at_border(domain, joint, random);
    if (what == 1) q[joint] = outside(domain, joint, random);
    out.push_back(q);
  }
  return out;
}

std::vector<Question> hostile_questions(const format::Model& model) {
  const double beyond = std::nextafter(1e4, Limits::infinity());
  std::vector<Question> out;
  for (std::size_t joint = 0; joint < model.domain.q_min.size(); ++joint)
    for (const double x : {Limits::quiet_NaN(), Limits::infinity(), Limits::max(), beyond, 1e4,
                           Limits::denorm_min(), 0.0})
      for (const double sign : {1.0, -1.0}) {
        Question q = middle(model.domain);
        q[joint] = sign * x;
        out.push_back(q);
      }
  return out;
}

std::vector<Question> border_questions(const format::Model& model, Random& random) {
  const format::Domain& domain = model.domain;
  std::vector<Question> out;
  for (const format::Tree& tree : model.trees)
    for (const format::TreeNode& node : tree.nodes) {
      if (!tree.directions.empty()) break;
      Question q;
      for (std::size_t i = 0; i < domain.q_min.size(); ++i)
        q.push_back(somewhere(domain, i, random));
      const double span = domain.q_max[node.input] - domain.q_min[node.input];
      const double x = domain.q_min[node.input] + 0.5 * span * (1.0 + node.threshold);
      for (const double at :
           {std::nextafter(x, -Limits::infinity()), x, std::nextafter(x, Limits::infinity())}) {
        q[node.input] = at;
        out.push_back(q);
      }
    }
  return out;
}

}  // namespace plumb::tests
