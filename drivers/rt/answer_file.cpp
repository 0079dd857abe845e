// SPDX-License-Identifier: Apache-2.0
#include "rt/answer_file.hpp"

#include <fmt/format.h>

#include <cstring>

#include "plumb/drivers/bus_content.hpp"
#include "program/file.hpp"
#include "program/problem.hpp"
#include "rt/creatable.hpp"

namespace plumb::drivers::rt {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, int error) {
  throw Failure(
      Exit::kEnvironment,
      {.code = "E-RT-SINK",
       .message = fmt::format("cannot write {}: {}", display_name(file), std::strerror(error)),
       .help = "choose another file in rt.toml, [sink] file"});
}

}  // namespace

void AnswerFile::check(const std::filesystem::path& file) {
  if (const int error = creation_error(file); error != 0) refuse(file, error);
}

AnswerFile::AnswerFile(const std::filesystem::path& file) : out_(file) {
  if (out_.error() != 0) refuse(file, out_.error());
  out_.add("t_s,counter,cx_mm,cy_mm,cz_mm,cqw,cqx,cqy,cqz\n");
}

void AnswerFile::add(const BusMessage& corrected) {
  if (corrected.kind != MessageKind::kCorrected) return;
  const auto X_BC = pose_in(corrected);
  if (!X_BC) return;
  const format::Pose pose = to_pose(*X_BC);
  out_.add(fmt::format("{:.6f},{},{:.6f},{:.6f},{:.6f},{:.9f},{:.9f},{:.9f},{:.9f}\n",
                       1e-9 * static_cast<double>(corrected.time_ns), corrected.counter,
                       1e3 * pose.p[0], 1e3 * pose.p[1], 1e3 * pose.p[2], pose.q[0], pose.q[1],
                       pose.q[2], pose.q[3]));
}

int AnswerFile::write() {
  out_.flush();
  return out_.error();
}

}  // namespace plumb::drivers::rt
