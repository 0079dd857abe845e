// SPDX-License-Identifier: Apache-2.0
#include "urdf/urdf_writer.hpp"

#include <fmt/format.h>

#include "cell/rotation.hpp"
#include "plumb/runtime/chain.hpp"

namespace plumb::offline {
namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (char c : text) switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  return out;
}

std::string origin(const Transformd& X) {
  const auto rpy = rpy_from_quaternion(to_pose(X).q);
  return fmt::format("<origin xyz=\"{:.17g} {:.17g} {:.17g}\" rpy=\"{:.17g} {:.17g} {:.17g}\"/>",
                     X.p(0), X.p(1), X.p(2), rpy[0], rpy[1], rpy[2]);
}

std::string link_name(std::size_t i, std::size_t joints) {
  return i == 0 ? "base_link" : i > joints ? "tool0" : fmt::format("link_{}", i);
}

}  // namespace

std::string write_urdf(const std::string& robot, const format::Chain& chain) {
  const Chain folded(chain);
  const std::size_t n = chain.joints.size();
  std::string out = fmt::format("<?xml version=\"1.0\"?>\n<robot name=\"{}\">\n", escaped(robot));
  for (std::size_t i = 0; i <= n + 1; ++i)
    out += fmt::format("  <link name=\"{}\"/>\n", link_name(i, n));
  for (std::size_t i = 0; i < n; ++i) {
    const auto& row = chain.joints[i];
    const bool turns = row.type == format::JointType::kRevolute;
    const Transformd zero =
        turns ? rot_z(row.offset + row.theta) : translation(0, 0, row.offset + row.d);
    out += fmt::format(
        "  <joint name=\"{}\" type=\"{}\">\n    {}\n    <parent link=\"{}\"/>\n    <child "
        "link=\"{}\"/>\n    <axis xyz=\"0 0 1\"/>\n    <limit lower=\"{:.17g}\" upper=\"{:.17g}\" "
        "effort=\"0\" velocity=\"0\"/>\n  </joint>\n",
        escaped(row.name), turns ? "revolute" : "prismatic",
        origin(folded.constant(static_cast<int>(i)) * zero), link_name(i, n), link_name(i + 1, n),
        row.q_min, row.q_max);
  }
  out += fmt::format(
      "  <joint name=\"tool0_joint\" type=\"fixed\">\n    {}\n    <parent link=\"{}\"/>\n    "
      "<child "
      "link=\"tool0\"/>\n  </joint>\n</robot>\n",
      origin(folded.constant(static_cast<int>(n))), link_name(n, n));
  return out;
}

}  // namespace plumb::offline
