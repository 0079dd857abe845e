// SPDX-License-Identifier: Apache-2.0
// The emitted C, compiled as its user would, beside the runtime that it must reproduce.
#include "compile/emit_c.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <sstream>

#include "c_program.hpp"
#include "plumb/format/reader.hpp"
#include "plumb/format/writer.hpp"
#include "plumb/runtime/forward_model.hpp"
#include "program/problem.hpp"
#include "questions.hpp"
#include "random_trees.hpp"

namespace plumb::offline {
namespace {

using tests::CHeader;
using tests::CProgram;
using tests::Question;

constexpr int kKinds = 64;          // all combinations of the switches of TreeKind
constexpr double kAllowed = 1e-12;  // of the size of an error
constexpr double kSize_m = 1e-3;

struct Sample {
  std::vector<format::Model> models;
  std::vector<CHeader> headers;
};

void add(Sample& out, const format::Model& model) {
  const std::string name = "m" + std::to_string(out.models.size());
  out.models.push_back(model);
  out.headers.push_back({name + ".h", name, emit_c(model, "out/" + name + ".h")});
}

/// Every kind of tree, or every `step`-th.
Sample all_kinds(std::uint64_t seed, int step = 1) {
  Sample out;
  for (int k = 0; k < kKinds; k += step) {
    const auto number = seed * kKinds + static_cast<std::uint64_t>(k);
    add(out, tests::random_tree_model(tests::kind_number(k, number), number));
  }
  return out;
}

struct Agreement {
  long answers = 0, same_bits = 0, same_status = 0, full = 0;
  double worst_m = 0.0;
};

int expected_status(const format::Model& model, const Question& q) {
  for (const double x : q)
    if (!(std::abs(x) <= 1e4)) return -1;
  std::vector<double> u(q.size());
  return TrainedDomain(model.domain).normalise(q, u) < 1.0 ? 1 : 0;
}

/// Whether a tree has as many leaves with a say as there may be.
bool is_full(const format::Model& model, const Question& q) {
  std::vector<double> u(q.size());
  TrainedDomain(model.domain).normalise(q, u);
  for (const format::Tree& tree : model.trees) {
    ActiveLeaves<double> active;
    TreeView(tree, static_cast<int>(q.size())).active(std::span<const double>(u), active);
    if (active.count == format::kMaxActiveLeaves) return true;
  }
  return false;
}

void compare(const CProgram& program, int k, const format::Model& model,
             const std::vector<Question>& asked, Agreement& out) {
  const ForwardModel arm(model);
  for (const Question& q : asked) {
    const CProgram::Answer answer = program(k, q);
    const Vector3 wanted = arm.tree_error(q);
    bool same = true;
    for (int axis = 0; axis < 3; ++axis) {
      const double got = answer.error_m[static_cast<std::size_t>(axis)];
      same =
          same && std::bit_cast<std::uint64_t>(got) == std::bit_cast<std::uint64_t>(wanted(axis));
      const double off = std::abs(got - wanted(axis));
      out.worst_m = off <= out.worst_m ? out.worst_m : off;
    }
    ++out.answers;
    out.same_bits += same ? 1 : 0;
    out.same_status += answer.status == expected_status(model, q) ? 1 : 0;
    out.full += is_full(model, q) ? 1 : 0;
  }
}

void print(const char* what, const Agreement& a) {
  std::printf("%s: %ld answers, %ld the same to the bit, %ld of full trees, worst %.3g m\n", what,
              a.answers, a.same_bits, a.full, a.worst_m);
}

TEST(EmitC, SaysToTheBitWhatTheRuntimeSaysForEveryKindOfTree) {
  for (long seed = 1; seed <= tests::scaled(1); ++seed) {
    const Sample sample = all_kinds(static_cast<std::uint64_t>(seed));
    for (const std::string& compiler :
         {std::string(tests::kStrictC) + " -O2", std::string(tests::kStrictCpp) + " -O1"}) {
      const CProgram program(sample.headers, compiler);
      ASSERT_EQ(program.complaint(), "");
      tests::Random random(static_cast<std::uint64_t>(seed));
      Agreement all;
      for (int k = 0; k < kKinds; ++k) {
        const format::Model& model = sample.models[static_cast<std::size_t>(k)];
        compare(program, k, model, tests::questions(model, 1000, random), all);
        compare(program, k, model, tests::border_questions(model, random), all);
        compare(program, k, model, tests::hostile_questions(model), all);
      }
      print(compiler.c_str(), all);
      EXPECT_EQ(all.same_bits, all.answers);
      EXPECT_EQ(all.same_status, all.answers);
      EXPECT_GT(all.full, 100);
      EXPECT_LE(all.worst_m, kAllowed * kSize_m);
    }
  }
}

TEST(EmitC, StaysWithinRoundingWhereTheCompilerContractsProducts) {
  const Sample sample = all_kinds(1000, 3);
  const CProgram program(sample.headers, "cc -O2 -march=native -ffp-contract=fast");
  ASSERT_EQ(program.complaint(), "");
  tests::Random random(1);
  Agreement all;
  for (std::size_t k = 0; k < sample.models.size(); ++k)
    compare(program, static_cast<int>(k), sample.models[k],
            tests::questions(sample.models[k], 1000, random), all);
  print("contracted", all);
  EXPECT_GT(all.answers, 20000);
  EXPECT_LE(all.worst_m, kAllowed * kSize_m);
}

TEST(EmitC, TheRandomModelsAreSoundSoThatTheyStandForFiles) {
  for (const format::Model& model : all_kinds(1).models) {
    const auto read = format::read_model(format::write_model(model));
    ASSERT_TRUE(std::holds_alternative<format::Model>(read));
    EXPECT_EQ(std::get<format::Model>(read).trees, model.trees);
  }
}

TEST(EmitC, TakesTheLargestTreesThatAModelMayHave) {
  Sample sample;
  for (const bool blended : {false, true})
    add(sample,
        tests::random_tree_model(
            {.joints = 9, .leaves = format::kMaxTreeLeaves, .blended = blended, .shared = true},
            3));
  const CProgram program(sample.headers, tests::kStrictC);
  ASSERT_EQ(program.complaint(), "");
  tests::Random random(1);
  Agreement all;
  for (int k = 0; k < 2; ++k) {
    const format::Model& model = sample.models[static_cast<std::size_t>(k)];
    compare(program, k, model, tests::questions(model, 1000, random), all);
  }
  print("largest", all);
  EXPECT_EQ(all.same_bits, all.answers);
}

TEST(EmitC, WhatIsNoJointStateGivesZerosAndIsRefused) {
  const Sample sample = all_kinds(7, 5);
  const CProgram program(sample.headers, std::string(tests::kStrictC) + " -O3");
  ASSERT_EQ(program.complaint(), "");
  int refused = 0;
  for (std::size_t k = 0; k < sample.models.size(); ++k)
    for (const Question& q : tests::hostile_questions(sample.models[k])) {
      const CProgram::Answer answer = program(static_cast<int>(k), q);
      for (const double e : answer.error_m) EXPECT_TRUE(std::isfinite(e));
      if (answer.status != -1) continue;
      ++refused;
      EXPECT_EQ(answer.error_m, (std::array<double, 3>{}));
    }
  EXPECT_GT(refused, 200);
}

TEST(EmitC, NoNameCanEndTheCommentThatItStandsIn) {
  Sample sample;
  tests::TreeKind kind{.joints = 2, .leaves = 3};
  for (const std::string& name : std::vector<std::string>{
           "*/ int x; /*", "*/\nint x;\n/*", "ends with \\", "\?\?/", "*\?\?/", "/", "*", "@_{}%s",
           "left\u202Eright", "// */ //", "Zelle 4 — 東", "\"quoted\"", "#define static", ""}) {
    format::Model model = tests::random_tree_model(kind, 1);
    model.cell_name = model.robot_name = model.serial = name;
    model.provenance.run = model.provenance.created = name;
    model.calibrated.joints[0].name = name;
    add(sample, model);
  }
  for (const std::string& compiler : {std::string(tests::kStrictC), std::string(tests::kStrictCpp)})
    EXPECT_EQ(CProgram(sample.headers, compiler).complaint(), "");
  const CProgram program(sample.headers, tests::kStrictC);
  tests::Random random(1);
  Agreement all;
  for (std::size_t k = 0; k < sample.models.size(); ++k)
    compare(program, static_cast<int>(k), sample.models[k],
            tests::questions(sample.models[k], 100, random), all);
  EXPECT_EQ(all.same_bits, all.answers);
}

TEST(EmitC, NoFileNameMakesAProgramThatDoesNotCompile) {
  const format::Model model = tests::random_tree_model({.joints = 2, .leaves = 3}, 1);
  for (const auto& [file, prefix] : std::vector<std::pair<std::string, std::string>>{
           {"7 axes.h", "model_7_axes"}, {"int.h", "int"}, {"*-.h", "model"}, {"Öl.h", "l"}}) {
    const CHeader header{file, prefix, emit_c(model, file)};
    EXPECT_EQ(CProgram({header}, tests::kStrictC).complaint(), "") << file;
    EXPECT_EQ(CProgram({header}, tests::kStrictCpp).complaint(), "") << file;
  }
}

TEST(EmitC, TwoModelsOfOneNameClashInsteadOfHidingEachOther) {
  const tests::TreeKind kind{.joints = 2, .leaves = 3};
  const CHeader one{"a-b.h", "a_b", emit_c(tests::random_tree_model(kind, 1), "a-b.h")};
  CHeader other{"a_b.h", "a_b", emit_c(tests::random_tree_model(kind, 2), "a_b.h")};
  EXPECT_NE(CProgram({one, other}, tests::kStrictC).complaint(), "");
  other.text = emit_c(tests::random_tree_model(kind, 1), "a_b.h");
  EXPECT_EQ(CProgram({one, other}, tests::kStrictC).complaint(), "");
}

TEST(EmitC, HasNoIncludeAndNothingThatCouldChange) {
  for (const CHeader& header : all_kinds(1).headers) {
    EXPECT_EQ(header.text.find("#include"), std::string::npos);
    std::istringstream lines(header.text);
    for (std::string line; std::getline(lines, line);) {
      EXPECT_EQ(line.find("@_"), std::string::npos) << line;
      if (line.rfind("static", 0) != 0) continue;
      EXPECT_TRUE(line.rfind("static const ", 0) == 0 || line.rfind("static inline ", 0) == 0)
          << line;
    }
  }
}

TEST(EmitC, SaysOfWhichRobotItIsAndHowGood) {
  format::Model model = tests::random_tree_model({.joints = 2, .leaves = 3}, 5);
  const auto has = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  const std::string text = emit_c(model, "x/arm.h");
  for (const auto* part : {"arm.h", "\"Cell\"", "\"Robot\"", "\"5\"", "plumb 0.0.0",
                           "over 20 poses [mm]: mean 0.0125", "int arm_tree_error(const double q["})
    EXPECT_TRUE(has(text, part)) << part;
  model.provenance.held_out = {};
  EXPECT_TRUE(has(emit_c(model, "arm.h"), "carries no held-out figure"));
}

TEST(EmitC, AModelWithoutATreeIsRefused) {
  format::Model model = tests::random_tree_model({.joints = 2, .leaves = 3}, 1);
  model.trees = {};
  try {
    (void)emit_c(model, "arm.h");
    FAIL() << "it was written";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.exit_code(), Exit::kInput);
    EXPECT_EQ(failure.problems().front().code, "E-EMIT-NO-TREE");
  }
}

}  // namespace
}  // namespace plumb::offline
