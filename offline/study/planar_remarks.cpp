// SPDX-License-Identifier: Apache-2.0
#include "study/planar_remarks.hpp"

#include <fmt/format.h>

namespace plumb::offline::study {
namespace {

std::string mm(double metres) { return fmt::format("{:.3g}", metres * 1e3); }

std::vector<std::string> about_the_arm(PlanarVariant variant) {
  if (variant == PlanarVariant::kPublished)
    return {
        "The printed figures come out only with bars of 100 mm (section 4 prints 60 mm) and with "
        "the loads of link 3 projected with cos phi23; statics wants cos(phi12 + phi23), because "
        "gravity does not turn with link 2. This variant follows the figures.",
        "So no law of physics fits this arm: correct beams leave {formula} mm, and what is left "
        "is structure that no effect of the library explains."};
  return {
      "This variant follows the printed text: bars of 60 mm and correct statics. It bends three "
      "times as much, so the paper's figures beside it are not for comparison.",
      "One number, 1/EI, explains it: the beam formula leaves {formula} mm, the law that runs in "
      "the cycle {flexure} mm, and 20 poses suffice where a tree needs "
      "hundreds."};
}

}  // namespace

std::vector<std::string> planar_remarks(PlanarVariant variant, const std::vector<StudyRow>& rows) {
  std::vector<std::string> out;
  for (const auto& text : about_the_arm(variant))
    out.push_back(fmt::format(fmt::runtime(text),
                              fmt::arg("formula", mm(row_of(rows, "beam_formula").test.mean)),
                              fmt::arg("flexure", mm(row_of(rows, "link_flexure").test.mean))));
  out.push_back(
      "The paper's test positions contain its training positions; the last columns are 20,000 "
      "random positions inside the trained box, none of them seen.");
  out.push_back(fmt::format(
      "The paper finds that smoothing makes trees worse ({} mm here). That holds while the leaves "
      "keep their coefficients, or are fitted one by one ({} mm): fitted all together the same "
      "class of model leaves {} mm.",
      mm(row_of(rows, "smoothed_kept").test.mean), mm(row_of(rows, "smoothed_local").test.mean),
      mm(row_of(rows, "blended_affine").test.mean)));
  out.push_back(
      "How the paper stopped its trees is not printed. Its sizes come out with Potts and Sammut's "
      "delta at (0.035 sigma)^2 and 10 samples a leaf, and, for the trees alone, grown out with 6 "
      "and 31 samples and full rank a leaf.");
  return out;
}

}  // namespace plumb::offline::study
