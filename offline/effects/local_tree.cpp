// SPDX-License-Identifier: Apache-2.0
#include "effects/descriptors.hpp"

namespace plumb::offline {
namespace {

constexpr const char* kForms[] = {"blended", "crisp"};
constexpr const char* kSplits[] = {"shared", "own"};

constexpr EffectOption kLocalTreeOptions[] = {
    {.key = OptionKey::kMinGain,
     .takes = EffectOption::Takes::kShare,
     .rule = "a share like \"2%\" or 0.02",
     .example = "2%"},
    {.key = OptionKey::kForm,
     .takes = EffectOption::Takes::kWord,
     .rule = "\"blended\" or \"crisp\"",
     .example = "crisp",
     .words = kForms},
    {.key = OptionKey::kSplits,
     .takes = EffectOption::Takes::kWord,
     .rule = "\"shared\" or \"own\"",
     .example = "own",
     .words = kSplits},
    {.key = OptionKey::kTreeDegree,
     .takes = EffectOption::Takes::kWhole,
     .rule = "1 (affine leaves) or 2 (quadratic ones too)",
     .example = "2",
     .least = 1.0,
     .most = 2.0}};

constexpr EffectDescriptor kLocalTreeDescriptor{
    .name = "local_tree",
    .explanation =
        "What physics leaves over, learnt as a local linear model tree over the joint positions: "
        "affine or quadratic leaves, blended smoothly into each other, or crisp where that is "
        "clearly better; held to what was seen there, fading out outside the trained domain. "
        "Kept only if it lowers the cross-validated error. Needs: dense poses. Options: min_gain "
        "= \"2%\"; form = \"blended\" or \"crisp\"; splits = \"shared\" by the axes or \"own\"; "
        "degree = 1 or 2.",
    .options = kLocalTreeOptions,
    .joints = JointList::kNone,
    .search = Search::kNever,

};

}  // namespace

const EffectDescriptor& local_tree_descriptor() { return kLocalTreeDescriptor; }

}  // namespace plumb::offline
