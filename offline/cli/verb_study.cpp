// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "cli/progress.hpp"
#include "cli/verbs.hpp"
#include "figures/study_figures.hpp"
#include "program/output_files.hpp"
#include "show/study_view.hpp"
#include "study/planar_physics.hpp"

namespace plumb::offline::cli {
namespace {

namespace fs = std::filesystem;

struct StudyArguments {
  std::string name, variant = "published", cell, figures;
  double noise_um = 0.0;
  int draws = 20;
  std::uint64_t seed = 1;
  bool without_finest = false;
  WriteOptions write;
};

PlanarVariant variant_of(const StudyArguments& options) {
  return options.variant == "printed" ? PlanarVariant::kPrinted : PlanarVariant::kPublished;
}

/// Says what is being done while it takes long.
class Steps {
 public:
  void operator()(const std::string& what) {
    now_.reset();
    now_ = std::make_unique<Progress>(what);
  }

 private:
  std::unique_ptr<Progress> now_;
};

void add_cell_files(const StudyArguments& options, OutputFiles& files) {
  study::PlanarCell planar =
      study::measured_cell({variant_of(options), planar_grid(study::kTrainingStep),
                            options.noise_um * 1e-6, options.seed});
  const fs::path folder = options.cell;
  planar.cell.directory = fs::absolute(folder);
  planar.cell.measurement.files = {planar.cell.directory / "measurements.csv"};
  files.add(folder / "cell.toml", write_cell(planar.cell));
  files.add(folder / "measurements.csv", planar.csv);
  files.add(folder / "truth.json", planar.truth_json);
}

void planar(const StudyArguments& options, Outcome& outcome) {
  OutputFiles files(options.cell.empty() ? options.figures : options.cell);
  if (!options.cell.empty()) {
    add_cell_files(options, files);
    outcome.result = {{"study", "planar"}, {"variant", options.variant}, {"cell", options.cell}};
    files.commit(options.write, outcome);
    outcome.text = fmt::format(
        "The arm of the study as a cell, variant '{}'.\n  {}\n\nNext, type\n"
        "  plumb -C {} diagnose --apply\n",
        options.variant,
        wrote(fs::path(options.cell) / "{cell.toml,measurements.csv,truth.json}", options.write),
        options.cell);
    return;
  }
  using Grids = study::PlanarRequest::Grids;
  Steps steps;
  const study::PlanarStudy found = study::run_planar_study(
      {.variant = variant_of(options),
       .noise_m = options.noise_um * 1e-6,
       .seed = options.seed,
       .grids = options.without_finest ? Grids::kWithoutFinest : Grids::kAll,
       .tell = [&](const std::string& what) { steps(what); }});
  outcome.result = show::planar_json(found);
  outcome.text = show::planar_text(found);
  if (options.figures.empty()) return;
  for (const auto& [name, text] : figures::planar_figures(found))
    files.add(fs::path(options.figures) / name, text);
  files.commit(options.write, outcome);
  outcome.text += "\n" + wrote(fs::path(options.figures) / "*.svg", options.write) + "\n";
}

void six_axis(const StudyArguments& options, Outcome& outcome) {
  Steps steps;
  const study::SixAxisStudy found = study::run_six_axis_study(
      {.draws = options.draws, .seed = options.seed, .tell = [&](const std::string& what) {
         steps(what);
       }});
  outcome.result = show::six_axis_json(found);
  outcome.text = show::six_axis_text(found);
}

void run_study(const StudyArguments& options, Outcome& outcome) {
  if (options.name == "planar") return planar(options, outcome);
  return six_axis(options, outcome);
}

}  // namespace

void add_study(Program& program) {
  const auto options = std::make_shared<StudyArguments>();
  VerbOptions verb =
      program.verb({.name = "study",
                    .summary = "Reproduce the published study, and see how far it can be beaten",
                    .examples = "  plumb study planar --figures figures\n  plumb study six-axis",
                    .in_cell = false},
                   [options](const Globals&, Outcome& o) { run_study(*options, o); });
  verb.add_option("NAME", options->name, "planar or six-axis")
      .required()
      .check(one_of({"planar", "six-axis"}));
  verb.add_option("--variant", options->variant,
                  "planar: the arm behind the published figures, or the one in print")
      .check(one_of({"published", "printed"}));
  verb.add_option("--noise-um", options->noise_um, "planar: noise per axis on what is learnt from")
      .check(number_between(0.0, 1e4));
  verb.add_option("--write-cell", options->cell,
                  "planar: write the arm and its 1536 measurements as a cell instead")
      .type_name("DIR");
  verb.add_option("--figures", options->figures, "planar: write the figures of the paper as SVG")
      .type_name("DIR");
  verb.add_flag("--without-finest", options->without_finest,
                "planar: leave out the 148,680 positions, which take most of the time");
  verb.add_option("--draws", options->draws, "six-axis: how many arms")
      .check(whole_number_between(1, 1000));
  verb.add_option("--seed", options->seed, "Seed of noise, poses and arms").check(seed_number());
  options->write.add_to(verb);
}

}  // namespace plumb::offline::cli
