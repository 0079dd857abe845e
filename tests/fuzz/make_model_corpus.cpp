// SPDX-License-Identifier: Apache-2.0
// make_model_corpus FOLDER: the first inputs of fuzz_model: every law of the catalogue on a small
// arm, a few in each file, and a law that turns the tip by more than any angle. The others beside
// them were found: one of each reason to refuse.
#include <cstdio>
#include <fstream>

#include "golden_models.hpp"
#include "plumb/format/writer.hpp"
#include "tests/rt/every_effect.hpp"

namespace {

using namespace plumb;

constexpr int kLawsInOneFile = 5;

void write(const std::string& file, const format::Model& model) {
  const auto bytes = format::write_model(model);
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()),
            static_cast<std::streamsize>(bytes.size()));
}

/// The golden arm with its sliding joint, or the one with a leaf.
format::Model arm(int number) {
  format::Model out = number % 2 == 0 ? format::planar_2r_model() : format::planar_model();
  tests::add_masses(out);
  return out;
}

/// Finite, so sound in a file; but no sine of such an angle is a number.
format::Model huge_turn() {
  format::Model out = arm(0);
  out.effects = {tests::typical_effect(out, find_effect_law("base_compliance"), 2)};
  out.effects[0].parameters.assign(6, 1e5);
  return out;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr, "usage: make_model_corpus FOLDER\n");
    return 2;
  }
  const std::string folder = arguments[1];
  for (int first = 0, file = 0; first < kEffectLaws; first += kLawsInOneFile, ++file) {
    format::Model model = arm(file);
    for (int law = first; law < std::min(first + kLawsInOneFile, kEffectLaws); ++law)
      if (effect_info(law).name != "formula")
        model.effects.push_back(tests::typical_effect(model, law, 2));
    if (model.effects.empty()) continue;
    if (find_effect_fault(model).kind != EffectFault::Kind::kNone) return 1;
    write(folder + "/laws_" + std::to_string(file) + ".plumb", model);
  }
  write(folder + "/huge_turn.plumb", huge_turn());
  return 0;
}
