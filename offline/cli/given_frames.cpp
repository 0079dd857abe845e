// SPDX-License-Identifier: Apache-2.0
#include "cli/given_frames.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <sstream>

#include "program/problem.hpp"
#include "programs/lexer.hpp"
#include "programs/written.hpp"

namespace plumb::offline::cli {
namespace {

std::optional<Transformd> frame_of(const std::string& text) {
  std::vector<double> numbers;
  std::istringstream in(text);
  for (std::string word; std::getline(in, word, ',');) {
    char* end = nullptr;
    numbers.push_back(std::strtod(word.c_str(), &end));
    if (word.empty() || *end != '\0' || !std::isfinite(numbers.back())) return std::nullopt;
  }
  return programs::pose_of(
      numbers.size() == 7 ? programs::Notation::kQuaternion : programs::Notation::kXyz, numbers);
}

}  // namespace

programs::Frames given_frames(const std::string& option, const std::vector<std::string>& words,
                              const format::Pose* model_tool) {
  programs::Frames out;
  for (const std::string& word : words) {
    const std::size_t equals = word.rfind('=');
    const bool named = equals != std::string::npos && equals > 0;
    const std::string value = named ? word.substr(equals + 1) : "";
    std::optional<Transformd> X;
    if (named)
      X = model_tool != nullptr && value == "model" ? from_pose(*model_tool) : frame_of(value);
    if (!X)
      throw Failure(Exit::kUsage,
                    {.code = "E-USAGE",
                     .message = fmt::format("{} holds '{}'", option, word),
                     .help = fmt::format("give a name, mm and deg (or a quaternion): {} "
                                         "NAME=0,0,150,0,0,0",
                                         option)});
    out[programs::lower_case(word.substr(0, equals))] = {.X = X, .why = ""};
  }
  return out;
}

}  // namespace plumb::offline::cli
