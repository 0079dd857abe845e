// SPDX-License-Identifier: Apache-2.0
#include "compile/emit_c.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <span>

#include "compile/c_tables.hpp"
#include "compile/c_text.hpp"
#include "compile/c_tree_code.hpp"
#include "plumb/format/crc32.hpp"
#include "program/problem.hpp"

namespace plumb::offline {
namespace {

constexpr double kMillimetres = 1e3;

void require_tree(const format::Model& model) {
  if (std::any_of(model.trees.begin(), model.trees.end(),
                  [](const format::Tree& tree) { return tree.leaves() > 0; }))
    return;
  throw Failure(
      Exit::kInput,
      {.code = "E-EMIT-NO-TREE",
       .message = "the model has no tree that could be written as C; no file was made",
       .help = "plumb add local_tree; if it is there already, plumb fit says why no tree helps"});
}

std::string held_out_text(const format::HeldOut& held) {
  if (held.poses == 0) return "The model carries no held-out figure.";
  return fmt::format(
      "Held-out error of the whole model over {} poses [mm]: mean {:.4f}, RMS {:.4f},\n"
      " * 95 % {:.4f}, largest {:.4f}.",
      held.poses, held.mean_m * kMillimetres, held.rms_m * kMillimetres, held.p95_m * kMillimetres,
      held.max_m * kMillimetres);
}

std::string head(const format::Model& model, const std::string& file) {
  const format::Provenance& from = model.provenance;
  return fmt::format(
      R"(/* {}: the local tree of a calibrated robot, as plain C99.
 *
 * Cell   "{}"
 * Robot  "{}"
 * Serial "{}"
 * Written by plumb {} from run "{}" of {}.
 * {}
 *
 * This is the tree alone. The calibrated chain and its effects are in the model file.
 * Made by plumb compile --emit-c; do not edit. Includes nothing, calls nothing, has no state.
 * -ffast-math would let NaN in; -ffp-contract=off gives the same bits as plumb's own cycle.
 */
)",
      c_comment_text(std::filesystem::path(file).filename().string()),
      c_comment_text(model.cell_name), c_comment_text(model.robot_name),
      c_comment_text(model.serial), c_comment_text(from.tool_version), c_comment_text(from.run),
      c_comment_text(from.created), held_out_text(from.held_out));
}

std::string cost(const format::Model& model) {
  std::size_t at_once = 1, leaves = 0;
  int depth = 0;
  for (const format::Tree& tree : model.trees) {
    const std::size_t room = tree.blend_half_width.empty() ? 1 : format::kMaxActiveLeaves;
    at_once = std::max(at_once, std::min(tree.leaves(), room));
    leaves = std::max(leaves, tree.leaves());
    depth = std::max<int>(depth, tree.depth);
  }
  return fmt::format("at most {} of {} leaves for each axis, {} levels deep", at_once, leaves,
                     depth);
}

std::string domain_text(const format::Model& model) {
  std::string out;
  for (std::size_t i = 0; i < model.domain.q_min.size(); ++i) {
    const format::JointRow& row = model.calibrated.joints[i];
    out +=
        fmt::format(" *   q[{}]  {:.6g} .. {:.6g} {}  \"{}\"\n", i, model.domain.q_min[i],
                    model.domain.q_max[i], row.type == format::JointType::kPrismatic ? "m" : "rad",
                    c_comment_text(row.name));
  }
  return out;
}

std::string function_comment(const format::Model& model) {
  return fmt::format(R"(/**
 * Position error of the tool that the tree knows of, along x, y, z of the robot's base: the tool is
 * there by so much more than the calibrated chain and its effects say.
 *
 * @param q        Joint positions in [rad], of sliding joints in [m].
 * @param error_m  In [m]; always written, always finite.
 * @return  0 inside the trained domain. 1 outside: q is taken at the border, and the error fades to
 *          zero within {:.6g} of the span. -1 if a q is NaN, infinite or beyond 1e4: zeros.
 *
 * Trained domain:
{} *
 * Cost: {}. Wait-free; any thread.
 */
)",
                     model.domain.fade, domain_text(model), cost(model));
}

std::string with_prefix(std::string_view text, const std::string& prefix) {
  std::string out;
  for (const char c : text) out += c == '@' ? prefix : std::string(1, c);
  return out;
}

}  // namespace

std::string emit_c(const format::Model& model, const std::string& file) {
  require_tree(model);
  const std::string prefix = c_identifier(file);
  const CTables numbers = c_tables(model);
  std::string body = with_prefix(numbers.sizes, prefix) + with_prefix(c_tree_types(), prefix) +
                     with_prefix(numbers.tables, prefix) + with_prefix(c_tree_functions(), prefix) +
                     function_comment(model) + with_prefix(c_tree_error(), prefix);
  // The guard contains a checksum of the body: two different models with one prefix then fail to
  // compile together, where otherwise the second would silently be skipped.
  const auto guard =
      fmt::format("PLUMB_{}_{:08X}", prefix, format::crc32p4(std::as_bytes(std::span(body))));
  return fmt::format("{0}#ifndef {1}\n#define {1}\n\n{2}\n#endif\n", head(model, file), guard,
                     body);
}

}  // namespace plumb::offline
