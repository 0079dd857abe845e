// SPDX-License-Identifier: Apache-2.0
// Rules about the chains and the texts.
#include "rule.hpp"

namespace plumb::format {
namespace {

void couple(Model& m, const std::vector<JointCoupling>& coupling) {
  m.nominal.coupling = m.calibrated.coupling = coupling;
}

std::vector<Rule> chain_rules() {
  return {
      {"NoJoints", "nominal: 0 joints", [](Model& m) { m.nominal.joints.clear(); }},
      {"TooManyJoints", "nominal: 10 joints",
       [](Model& m) { m.nominal.joints.resize(10, m.nominal.joints[0]); }},
      {"ChainsDifferInCount", "differ in the number",
       [](Model& m) { m.calibrated.joints.pop_back(); }},
      {"ChainsDifferInType", "joint 2 differs",
       [](Model& m) { m.calibrated.joints[1].type = JointType::kPrismatic; }},
      {"ChainsDifferInName", "joint 2 differs",
       [](Model& m) { m.calibrated.joints[1].name = "K"; }},
      {"ChainsDifferInConvention", "differ in the DH convention",
       [](Model& m) { m.calibrated.convention = Convention::kModified; }},
      {"ChainsDifferInCoupling", "differ in the coupling",
       [](Model& m) {
         m.calibrated.coupling = {{2, 1, -1.0}};
       }},
      {"CouplingOfNoJoint", "couples a joint that it does not have",
       [](Model& m) {
         couple(m, {{6, 1, -1.0}});
       }},
      {"CouplingOfKinds", "turns with one that slides",
       [](Model& m) {
         m.nominal.joints[2].type = m.calibrated.joints[2].type = JointType::kPrismatic;
         couple(m, {{2, 1, -1.0}});
       }},
      {"CouplingByNothing", "ratio 0 of two",
       [](Model& m) {
         couple(m, {{2, 1, 0.0}});
       }},
      {"CouplingNaN", "ratio nan of two",
       [](Model& m) {
         couple(m, {{2, 1, kNaN}});
       }},
      {"CouplingTwice", "couples two joints twice",
       [](Model& m) {
         couple(m, {{2, 1, 1.0}, {2, 1, -1.0}});
       }},
      {"CouplingInACircle", "depend on each other",
       [](Model& m) {
         couple(m, {{2, 1, 1.0}, {1, 2, 1.0}});
       }},
      {"TooManyCouplings", "too many couplings",
       [](Model& m) {
         couple(m, std::vector<JointCoupling>(37, {2, 1, 1.0}));
       }},
      {"Convention", "unknown DH convention",
       [](Model& m) { m.nominal.convention = m.calibrated.convention = Convention{2}; }},
      {"JointType", "joints[1]: unknown type",
       [](Model& m) { m.nominal.joints[0].type = m.calibrated.joints[0].type = JointType{2}; }},
      {"JointWithoutName", "joints[1] has no name",
       [](Model& m) { m.nominal.joints[0].name = ""; }},
      {"JointName", "joints[1].name holds control",
       [](Model& m) { m.nominal.joints[0].name = "\t"; }},
      {"NaNLength", "joints[4]: length", [](Model& m) { m.calibrated.joints[3].a = kNaN; }},
      {"HugeLength", "calibrated.joints[4]: length 600 m",
       [](Model& m) { m.calibrated.joints[3].d = 600.0; }},
      {"InfiniteAlpha", "angle inf", [](Model& m) { m.calibrated.joints[3].alpha = kInf; }},
      {"HugeTheta", "angle 13", [](Model& m) { m.calibrated.joints[3].theta = 13.0; }},
      {"NaNBeta", "angle nan", [](Model& m) { m.calibrated.joints[3].beta = kNaN; }},
      {"ScaleLow", "scale 0.4", [](Model& m) { m.calibrated.joints[3].scale = 0.4; }},
      {"ScaleHigh", "scale 2.1", [](Model& m) { m.calibrated.joints[3].scale = 2.1; }},
      {"ScaleNaN", "scale nan", [](Model& m) { m.calibrated.joints[3].scale = kNaN; }},
      {"Offset", "offset is out of range", [](Model& m) { m.calibrated.joints[3].offset = kNaN; }},
      {"EmptyLimits", "the limits -3 … -3",
       [](Model& m) { m.nominal.joints[0].q_max = m.nominal.joints[0].q_min; }},
      {"NaNLowerLimit", "are no range", [](Model& m) { m.nominal.joints[0].q_min = kNaN; }},
      {"InfiniteUpperLimit", "are no range", [](Model& m) { m.nominal.joints[0].q_max = kInf; }},
      {"Pre", "joints[1].pre: nan", [](Model& m) { m.calibrated.joints[0].pre.d[2] = kNaN; }},
      {"Post", "joints[1].post: 2", [](Model& m) { m.calibrated.joints[0].post.e[1] = 2.0; }},
      {"BaseTwist", "base_twist: -2", [](Model& m) { m.calibrated.base_twist.d[0] = -2.0; }},
      {"ToolTwist", "tool_twist: nan", [](Model& m) { m.calibrated.tool_twist.e[0] = kNaN; }},
      {"Base", "base: translation 101", [](Model& m) { m.calibrated.base.p[1] = 101.0; }},
      {"Tool", "tool: translation nan", [](Model& m) { m.nominal.tool.p[1] = kNaN; }},
      {"BaseQuaternion", "nominal.base: the quaternion",
       [](Model& m) { m.nominal.base.q[1] = 1e-4; }},
      {"ToolQuaternion", "calibrated.tool: the quaternion",
       [](Model& m) { m.calibrated.tool.q[0] = kNaN; }},
      {"ZeroQuaternion", "the quaternion", [](Model& m) { m.calibrated.tool.q[0] = 0.0; }},
      {"Gravity", "gravity", [](Model& m) { m.gravity[2] = kNaN; }},
      {"HugeGravity", "gravity", [](Model& m) { m.gravity[0] = 101.0; }},
  };
}

std::vector<Rule> text_rules() {
  return {
      {"NewLine", "control characters", [](Model& m) { m.serial = "a\nb"; }},
      {"Delete", "control characters", [](Model& m) { m.cell_name = "\x7F"; }},
      {"TerminalEscape", "control characters", [](Model& m) { m.serial = "\xC2\x9B"; }},
      {"ZeroByte", "control characters", [](Model& m) { m.robot_name = std::string(1, '\0'); }},
      {"LongName", "longer than 256", [](Model& m) { m.robot_name = std::string(257, 'x'); }},
      {"Latin1", "not UTF-8",
       [](Model& m) {
         m.robot_name =
             "Gr\xF6\xDF"
             "e";
       }},
      {"LoneContinuation", "not UTF-8", [](Model& m) { m.robot_name = "\x80"; }},
      {"CutSequence", "not UTF-8", [](Model& m) { m.robot_name = "\xE6\x9D"; }},
      {"Overlong", "not UTF-8", [](Model& m) { m.robot_name = "\xC0\xAF"; }},
      {"Surrogate", "not UTF-8", [](Model& m) { m.robot_name = "\xED\xA0\x80"; }},
      {"BeyondUnicode", "not UTF-8", [](Model& m) { m.robot_name = "\xF4\x90\x80\x80"; }},
  };
}

INSTANTIATE_TEST_SUITE_P(Chains, SemanticRule, ::testing::ValuesIn(chain_rules()), name_of);
INSTANTIATE_TEST_SUITE_P(Texts, SemanticRule, ::testing::ValuesIn(text_rules()), name_of);

}  // namespace
}  // namespace plumb::format
