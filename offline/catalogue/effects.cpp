// SPDX-License-Identifier: Apache-2.0
#include "catalogue/explanation.hpp"

namespace plumb::offline {
namespace {

constexpr Explanation kEffects[] = {
    {"geometry",
     "Constant errors of the links: DH parameters, with Hayati's beta where neighbouring axes are "
     "near parallel, or six small motions per link. Fitted as the subset that the poses can tell "
     "apart. Typical: 0.5 mm, 0.5 mrad. Needs: nothing but poses. Always listed first."},
    {"local_tree",
     "What physics leaves over, learnt as a local linear model tree over the joint positions: "
     "affine or quadratic leaves, blended smoothly into each other, or crisp where that is clearly "
     "better; held to what was seen there, fading out outside the trained domain. Kept only if it "
     "lowers the cross-validated error. Needs: dense poses. Options: min_gain = \"2%\"; form = "
     "\"blended\" or \"crisp\"; splits = \"shared\" by the axes or \"own\"; degree = 1 or 2."},
    {"joint_compliance",
     "A joint turns under its load: dq = c tau, tau being the torque of gravity and payload about "
     "the joint. Heavy arms 1e6 to 4e6 N m/rad, light ones 1e4 to 1e5. Needs: link masses or the "
     "free gravity basis; column payload_kg if the payload varies."},
    {"joint_compliance_soft",
     "Joint compliance with a soft start: dq = tau/K + D0 (1 - exp(-|tau|/tau1)) sign(tau). Gears "
     "yield most while the load is small. Needs: as joint_compliance."},
    {"gravity_free",
     "Gravity torque without known masses: per joint, the components of gravity in the link frames "
     "with free factors, reduced to what can be told apart. Needs: poses in many orientations."},
    {"link_flexure",
     "A link bends like a cantilever under force and moment at its end, and under its own weight; "
     "usually 5 to 30 % of the joint compliance. Needs: masses, payload; EI, GJ and length help."},
    {"gear_harmonics",
     "A joint's error repeats once and twice a turn: dq = sum A_h sin(h q + phi_h), h = 1, 2. "
     "Typical: 100 urad. Needs: poses over most of the joint's range."},
    {"gear_ripple",
     "The same at k cycles per joint turn, k from 0.5 to 40 and not always whole: tooth "
     "engagement, "
     "wave generator. Some arms show 300 urad. Needs: gear ratio or enough poses for a scan; a "
     "regular grid of poses can hide it."},
    {"joint_table",
     "dq as a periodic table of q, a few degrees a step: any repeating error of one joint. "
     "Needs: dense data over the whole range."},
    {"encoder_scale",
     "The encoder counts too much or too little: dq = s q, s of 1e-5 to 1e-4. Needs: poses at both "
     "ends of the range."},
    {"encoder_eccentricity",
     "The code disc runs off centre: dq = atan2(e sin a, 1 + e cos a). To first order the same as "
     "the first harmonic: the two cannot be told apart. Typical: 100 urad."},
    {"reversal",
     "The joint stops short of where it came from: dq = -h sign(d)(1 - exp(-|travel|/q_c)). "
     "Typical: 30 to 300 urad. Needs: columns dir_jN and travel_jN, or rows in order of moving."},
    {"backlash_load",
     "The gear's play is taken up by the load: dq = b/2 tanh(tau/tau0). Typical: 30 to 290 urad. "
     "Needs: masses and payload."},
    {"settling_lag",
     "Joints were read before the arm stood still: dq in proportion to the last step's share. "
     "Belongs to the procedure: it cleans the fit and is not compiled. Needs: order of poses."},
    {"axis_wobble",
     "The joint's axis tilts and shifts once and twice a turn: bearing run-out. Typical: 10 to 50 "
     "urad, 2 to 20 um. Needs: poses over the joint's range."},
    {"wrist_coupling",
     "Turning one wrist joint turns the next through their common gears: dq5 = k45 q4, dq6 = k46 "
     "q4 + k56 q5. Typical: 1e-5 to 1e-3."},
    {"cross_compliance",
     "One joint yields under the torque of another: dq_i = c tau_j. Needs: masses."},
    {"thermal_growth",
     "Links grow: d_i (1 + alpha dT), with a lag if wanted; steel 12e-6/K, aluminium 23e-6/K. "
     "Needs: temp_NAME_degC, or time. At one temperature it cannot be told from geometry."},
    {"base_compliance",
     "The base tilts under the arm's moment: rotation = M0 / K. Typical: 1e-9 to 1e-6 rad/(N m). "
     "Needs: masses."},
    {"tool_sag",
     "The tool sags under its weight: displacement = C (R^T g) m. Typical: 1 to 50 um. "
     "Needs: payload."},
    {"gravity_compensator",
     "A spring that carries the second joint. It depends on q2 alone and cannot be told from "
     "that joint's harmonics."},
    {"payload_compliance",
     "Joints yield under the payload alone: dq = c J^T W. Needs: a payload that varies."},
    {"wrench_compliance",
     "Joints yield under a force at the tool: dq = c J^T W. Needs: columns of force and torque."},
    {"drift",
     "Base or tracker moves slowly with time: a small motion times t, t^2 or, with settling_s = T, "
     "1 - exp(-t/T). Typical: 50 um/h. Belongs to the measurement, not compiled. Needs: time."},
    {"step",
     "From some pose on all is shifted: a reflector re-seated, a tracker bumped, an encoder "
     "slipped. Belongs to the measurement. Needs: order of poses. Looked for before drift."},
    {"tracker",
     "Errors of the instrument: radial offset, scale with range, second harmonic of its angles. "
     "Typical: 30 um, 2e-6/K, 6e-6. Belongs to the measurement. Needs: where the tracker stands."},
    {"formula",
     "An effect of your own under [[effects.formula]]: target = \"dq2\", expression = \"k * "
     "tau2\", "
     "parameters = [\"k [rad/(N m)] ~ 1e-6\"]. Targets dq1, pre1.rx, post1.dz, base.dx, tool.rz, "
     "tcp.x and the like; it reads q1 tau1 dir1 travel1 u1 and so on, t, payload, temp_NAME, x y "
     "z, "
     "row. Units are checked. Needs: the columns of what it reads."},
};

}  // namespace

std::span<const Explanation> effect_explanations() { return kEffects; }

}  // namespace plumb::offline
