// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <set>

#include "arm/neighbouring_axes.hpp"
#include "cell/cell.hpp"
#include "cell/link_frame.hpp"
#include "cli/dh_file.hpp"
#include "cli/next_line.hpp"
#include "cli/verbs.hpp"
#include "effects/registry.hpp"
#include "program/bounded_file.hpp"
#include "program/file.hpp"
#include "program/output_files.hpp"
#include "program/printable.hpp"
#include "urdf/urdf_reader.hpp"

namespace plumb::offline::cli {
namespace {

namespace fs = std::filesystem;

/// An arm whose links add up to more or less than these has, most often, lengths in another unit.
constexpr double kLongestReach_m = 25.0, kShortestReach_m = 0.05;

struct NewArguments {
  std::string directory, dh, urdf, tip, base, convention, name, serial;
  WriteOptions write;
};

void check(const NewArguments& options) {
  if (!options.urdf.empty() && !options.dh.empty())
    throw Failure(Exit::kUsage, {.code = "E-USAGE",
                                 .message = "--dh and --urdf both describe the arm",
                                 .help = "give one of them"});
  if (options.urdf.empty() && !(options.tip.empty() && options.base.empty()))
    throw Failure(Exit::kUsage, {.code = "E-USAGE",
                                 .message = "--tip and --base name links of a URDF file",
                                 .help = "plumb new DIR --urdf arm.urdf --tip LINK --base LINK"});
  if (!options.urdf.empty()) return;
  if (options.dh.empty())
    throw Failure(Exit::kUsage, {.code = "E-USAGE",
                                 .message = "new needs the DH table of the arm",
                                 .help = "plumb new DIR --dh dh.csv --convention standard"});
  if (options.convention.empty())
    throw Failure(Exit::kUsage,
                  {.code = "E-USAGE",
                   .message = "--convention is missing: the same table means another arm in the "
                              "other convention",
                   .help = "--convention standard (distal) or --convention modified (Craig)"});
}

/// Neighbours whose axes are parallel: the link between them turns about x by 0 or 180 deg.
std::vector<JointMechanics> mechanics_of(const format::Chain& chain) {
  std::vector<JointMechanics> out(chain.joints.size());
  for (std::size_t i = 0; i + 1 < chain.joints.size(); ++i)
    out[i].parallel_next = near_parallel(chain, static_cast<int>(i));
  return out;
}

/// DH rows are computed, so the convention is a matter of taste.
Cell urdf_cell(const NewArguments& options, format::Convention convention, Outcome& outcome) {
  outcome.inputs.push_back(
      {display_name(options.urdf), sha256(read_file_up_to(options.urdf, kMostUrdfBytes))});
  if (options.convention.empty())
    outcome.remarks.push_back({.severity = Severity::kNote,
                               .code = "N-NEW-CONVENTION",
                               .message = "the DH rows are written in the standard convention",
                               .help = "--convention modified for the other one"});
  std::vector<Problem> remarks;
  Cell cell =
      read_urdf(options.urdf, {.tip = options.tip, .base = options.base}, convention, &remarks);
  outcome.remark(remarks);
  return cell;
}

/// An arm of hundreds of metres or of a millimetre is most often written in another unit.
void doubt_reach(const NewArguments& options, const Cell& cell, Outcome& outcome) {
  const double size_m = stretched_length(cell.nominal);
  if (size_m == 0.0 || (size_m < kLongestReach_m && size_m > kShortestReach_m)) return;
  const bool urdf = !options.urdf.empty();
  outcome.remarks.push_back(
      {.severity = Severity::kWarning,
       .code = "W-NEW-REACH",
       .message = fmt::format("the links of this arm add up to {:.3g} m{}", size_m,
                              urdf ? ", and URDF is in metres" : ""),
       .place = Place{.file = display_name(urdf ? options.urdf : options.dh)},
       .help = urdf
                   ? "if its lengths are in mm: export it in metres, or divide every xyz by 1000"
                   : "if the header names another unit than the numbers have, correct it: a_mm and "
                     "d_mm, or a_m and d_m"});
}

/// The name of a joint as the cell file can hold it: without dots and blanks, because parameters
/// ("J2.d") and lists refer to it.
std::string joint_name(const std::string& given) {
  std::string out = valid_utf8(given);
  for (char& c : out)
    if (c == '.' || static_cast<unsigned char>(c) <= ' ' || c == 0x7F) c = '_';
  return out.empty() ? "J" : out;
}

/// Names that the reader of cell files accepts; every change is reported.
void make_readable(Cell& cell, Outcome& outcome) {
  cell.name = valid_utf8(cell.name);
  cell.serial = valid_utf8(cell.serial);
  cell.robot_name = valid_utf8(cell.robot_name);
  std::set<std::string> taken;
  for (auto& row : cell.nominal.joints) {
    const std::string name = joint_name(row.name);
    std::string free = name;
    for (int k = 2; !taken.insert(free).second; ++k) free = fmt::format("{}_{}", name, k);
    if (free != row.name)
      outcome.remarks.push_back(
          {.severity = Severity::kNote,
           .code = "N-NEW-JOINT",
           .message = fmt::format("joint '{}' is called '{}' in cell.toml", row.name, free),
           .help = "names of joints are different words without dots and blanks"});
    row.name = free;
  }
}

Cell new_cell(const NewArguments& options, const fs::path& folder, Outcome& outcome) {
  const auto convention = options.convention == "modified" ? format::Convention::kModified
                                                           : format::Convention::kStandard;
  Cell cell;
  if (!options.urdf.empty()) cell = urdf_cell(options, convention, outcome);
  cell.directory = folder;
  cell.name = options.name.empty() ? folder.filename().string() : options.name;
  cell.serial = options.serial;
  if (options.urdf.empty()) {
    cell.robot_name = cell.name;
    DhTable table = read_dh(options.dh, convention, outcome);
    cell.nominal = std::move(table.chain);
    cell.assumed_limits = std::move(table.assumed_limits);
    cell.mechanics = mechanics_of(cell.nominal);
  }
  doubt_reach(options, cell, outcome);
  make_readable(cell, outcome);
  cell.measurement.files = {folder / "measurements.csv"};
  cell.effects = {{.name = geometry_effect(), .joints = {}, .options = {}, .place = {}}};
  return cell;
}

void make(const NewArguments& options, const Globals&, Outcome& outcome) {
  check(options);
  const fs::path folder = fs::absolute(options.directory).lexically_normal();
  const fs::path named = folder.has_filename() ? folder : folder.parent_path();
  const Cell cell = new_cell(options, named, outcome);
  const fs::path file = fs::path(options.directory) / "cell.toml";
  OutputFiles files(options.directory);
  const std::string text = write_cell(cell);
  (void)parse_cell(text, fs::absolute(file));  // our own reader must accept it
  files.add(file, text);
  outcome.result = {{"cell", cell.name}, {"joints", cell.joints()}};
  files.commit(options.write, outcome);
  outcome.text = fmt::format(
      "A cell for an arm of {} joints, {} DH.\n\n  {}\n\nThe measurements belong into {}.\n",
      cell.joints(), options.convention.empty() ? "standard" : options.convention,
      wrote(file, options.write), (fs::path(options.directory) / "measurements.csv").string());
  say_next({.directory = options.directory}, "import tracker.txt   # or: fit, if it is there",
           outcome);
}

}  // namespace

void add_new(Program& program) {
  const auto options = std::make_shared<NewArguments>();
  VerbOptions verb =
      program.verb({.name = "new",
                    .summary = "Write a commented cell.toml from a DH table or a URDF file",
                    .examples = "  plumb new mycell --dh dh.csv --convention modified\n"
                                "  plumb new mycell --urdf arm.urdf --tip tool0 --name \"Cell 4\"",
                    .in_cell = false},
                   [options](const Globals& g, Outcome& o) { make(*options, g, o); });
  verb.add_option("DIR", options->directory, "Folder of the new cell").required();
  verb.add_option(
          "--dh", options->dh,
          "CSV file with the columns joint, alpha_deg, a_mm, d_mm, theta_deg; and, if known, "
          "q_min_deg, q_max_deg, q_min_mm, q_max_mm, type")
      .type_name("FILE");
  verb.add_option("--urdf", options->urdf, "URDF file: its DH rows are computed").type_name("FILE");
  verb.add_option("--tip", options->tip, "Link of the URDF where the arm ends; else its only tip")
      .type_name("LINK");
  verb.add_option("--base", options->base, "Link of the URDF where the arm begins; else its root")
      .type_name("LINK");
  verb.add_option("--convention", options->convention, "standard (distal) or modified (Craig)")
      .check(one_of({"standard", "modified"}))
      .type_name("NAME");
  verb.add_option("--name", options->name, "Name of the cell; else that of the folder")
      .type_name("TEXT");
  verb.add_option("--serial", options->serial, "Serial number, bound into compiled models")
      .type_name("TEXT");
  options->write.add_to(verb);
}

}  // namespace plumb::offline::cli
