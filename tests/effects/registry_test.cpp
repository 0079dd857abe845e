// SPDX-License-Identifier: Apache-2.0
#include "effects/registry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "effects/fitted_laws.hpp"

namespace plumb::offline {
namespace {

namespace fs = std::filesystem;

TEST(EffectRegistry, TheProcedureIsNoErrorOfOneMeasurement) {
  for (const char* name : {"drift", "step", "tracker"})
    EXPECT_TRUE(is_of_measurement(name)) << name;
  for (const char* name : {"settling_lag", "joint_compliance", "geometry", "formula", "no_effect"})
    EXPECT_FALSE(is_of_measurement(name)) << name;
}

TEST(EffectRegistry, HasExactlyOneDescriptorForEveryLawInTheOrderOfTheLibrary) {
  std::vector<std::string_view> described;
  for (const EffectDescriptor* effect : effect_descriptors())
    if (effect->law != nullptr) described.push_back(effect->name);
  std::vector<std::string_view> library;
  for (int law = 0; law < kFittedLaws; ++law) library.push_back(fitted_law_info(law).name);
  EXPECT_EQ(described, library);
  for (const EffectDescriptor* effect : effect_descriptors()) {
    EXPECT_EQ(find_descriptor(effect->name), effect) << effect->name;
    if (effect->law != nullptr) {
      EXPECT_EQ(effect->law->name, effect->name);
    }
  }
}

TEST(EffectRegistry, GeometryAndTheLocalTreeAreTheOnlyEffectsThatAreNoLaws) {
  const auto all = effect_descriptors();
  ASSERT_EQ(all.size(), 2U + static_cast<std::size_t>(kFittedLaws));
  EXPECT_EQ(all[0]->name, "geometry");
  EXPECT_EQ(all[1]->name, "local_tree");
  EXPECT_EQ(all[0]->law, nullptr);
  EXPECT_EQ(all[1]->law, nullptr);
}

TEST(EffectRegistry, EveryLawExplainsItselfAndSaysWhichDataShowIt) {
  for (const EffectDescriptor* effect : effect_descriptors()) {
    EXPECT_GT(std::string(effect->explanation).size(), 60U) << effect->name;
    if (effect->law == nullptr) continue;
    ASSERT_NE(effect->testable, nullptr) << effect->name;
    EXPECT_NE(std::string(effect->measure), "") << effect->name;
    const bool names_itself = effect->entry_title != nullptr || is_formula(effect->name);
    EXPECT_EQ(std::string(effect->sentence).empty(), names_itself) << effect->name;
  }
}

/// Data of six joints that show nothing: every rule must find words for them.
TEST(EffectRegistry, EveryRuleAnswersForDataThatShowNothing) {
  DataSense data;
  data.names = {"J1", "J2", "J3", "J4", "J5", "J6"};
  data.turns.assign(6, true);
  data.range.assign(6, 0.0);
  data.both_ways.assign(6, -1.0);
  data.has_travel.assign(6, false);
  data.has_gear_ratio.assign(6, false);
  data.lever_m.assign(6, 0.0);
  for (const EffectDescriptor* effect : effect_descriptors()) {
    if (effect->testable == nullptr) continue;
    const Testability found = effect->testable(data);
    EXPECT_NE(found.answer, Testability::Answer::kYes) << effect->name;
    EXPECT_NE(found.why, "") << effect->name;
  }
}

TEST(EffectRegistry, ConstantsAndOptionsAreDescribedCompletely) {
  for (const EffectDescriptor* effect : effect_descriptors()) {
    const bool has_constants = effect->law != nullptr && !effect->law->constants.empty();
    EXPECT_EQ(effect->bind != nullptr, has_constants) << effect->name;
    std::set<OptionKey> keys;
    for (const EffectOption& option : effect->options) {
      EXPECT_TRUE(keys.insert(option.key).second) << effect->name << " " << option.name();
      EXPECT_NE(std::string(option.name()), "") << effect->name;
      EXPECT_NE(std::string(option.rule), "") << effect->name << " " << option.name();
      EXPECT_NE(std::string(option.example), "") << effect->name << " " << option.name();
      EXPECT_EQ(option.words.empty(), option.takes != EffectOption::Takes::kWord);
      EXPECT_LE(option.credible_least, option.credible_most);
    }
    for (const GridAxis& axis : effect->grid) {
      EXPECT_TRUE(keys.contains(axis.key)) << effect->name;
      EXPECT_EQ(axis.values.empty(), axis.kind == GridAxis::Values::kSensors) << effect->name;
    }
    if (effect->refinement != nullptr) {
      EXPECT_TRUE(keys.contains(effect->refinement->key)) << effect->name;
      EXPECT_GT(effect->refinement->factor, 1.0) << effect->name;
      EXPECT_GT(effect->refinement->most, 0.0) << effect->name;
    }
    if (effect->told_apart_by != nullptr) {
      EXPECT_TRUE(keys.contains(*effect->told_apart_by)) << effect->name;
    }
  }
}

TEST(EffectRegistry, CandidatesAreMadeForJointsThatAnEntryMayList) {
  for (const EffectDescriptor* effect : effect_descriptors()) {
    if (effect->law == nullptr) continue;
    const bool set = effect->joints == JointList::kSet || effect->joints == JointList::kSliding;
    EXPECT_EQ(effect->law->per_joint, set) << effect->name;
    const bool pair = effect->joints == JointList::kOrderedPair;
    EXPECT_EQ(std::string(effect->pair).empty(), !pair) << effect->name;
    if (effect->candidate_joints == CandidateJoints::kEach ||
        effect->candidate_joints == CandidateJoints::kSecond) {
      EXPECT_EQ(effect->joints, JointList::kSet) << effect->name;
    }
    EXPECT_EQ(effect->candidate_joints == CandidateJoints::kSliding,
              effect->joints == JointList::kSliding)
        << effect->name;
    if (effect->at_slide != nullptr) {
      EXPECT_EQ(effect->candidate_joints, CandidateJoints::kEach) << effect->name;
      EXPECT_EQ(effect->at_slide->grid.empty(), effect->grid.empty()) << effect->name;
      EXPECT_GT(effect->at_slide->typical, 0.0) << effect->name;
    }
    if (effect->candidate_joints == CandidateJoints::kLoadedPairs ||
        effect->candidate_joints == CandidateJoints::kNeighbours) {
      EXPECT_EQ(effect->joints, JointList::kOrderedPair) << effect->name;
    }
    if (effect->group_share > 0.0) {
      EXPECT_EQ(effect->candidate_joints, CandidateJoints::kEach) << effect->name;
    }
    for (const std::string_view other : effect->same_motion)
      EXPECT_NE(find_descriptor(other), nullptr) << effect->name << " " << other;
  }
}

/// A file, or a folder, whose string literals may be names of effects. Of no literal: of all.
struct OtherMeaning {
  const char* place;
  const char* literal;
};
constexpr OtherMeaning kOtherMeanings[] = {
    {"bench/step_instructions.cpp", nullptr},   // instructions that were counted of each law
    {"catalogue/terms.cpp", "reversal"},        // a term that is explained
    {"cell/effects_reader.cpp", "geometry"},    // a key of the cell file
    {"check/convention_words.cpp", "tracker"},  // the end of a sentence
    {"check/data_sense.cpp", "tracker"},        // the value of a comment "# frame: tracker"
    {"check/row_pattern.cpp", "tracker"},       // the instrument, in a sentence
    {"cli/verb_export.cpp", "local_tree"},      // what a URDF file leaves out, in a sentence
    {"runs/model_json.cpp", "formula"},         // a key of the run's JSON file
    {"formula/names.cpp", "step"},              // a function of formulas
    {"import/words.cpp", "tracker"},            // a word of column names
    {"show/check_json.cpp", "step"},            // keys of what the verbs print with --json
    {"show/diagnose_json.cpp", "formula"},
    {"show/fit_view.cpp", "geometry"},
    {"show/model_view.cpp", "formula"},
    {"show/planar_view.cpp", "link_flexure"},  // a row of the study's table
    {"simulate/", nullptr},                    // laws of its own that have the same names
    {"study/", nullptr},                       // the effects of the published study
    {"twin/", nullptr},                        // laws of the simulator
    {"workbench/page/", "formula"},            // words of the command line, and the name of a task
    {"workbench/page/", "geometry"},
};

bool means_something_else(const std::string& place, const std::string& name) {
  return std::any_of(std::begin(kOtherMeanings), std::end(kOtherMeanings), [&](const auto& one) {
    return place.starts_with(one.place) && (one.literal == nullptr || name == one.literal);
  });
}

/// Names of effects that a source text compares with or has as values: its string literals, and in
/// TypeScript the words of what is tested as a regular expression; outside of comments.
std::vector<std::string> effect_names_in(const std::string& source) {
  std::vector<std::string> out;
  std::istringstream lines(source);
  const std::regex literal("\"((?:[^\"\\\\]|\\\\.)*)\"");
  const std::regex comment("(^|[^:\"])//.*");
  const std::regex tested("/([^/]+)/\\.test\\("), word("[a-z_]+");
  const auto take = [&](const std::string& name) {
    if (find_descriptor(name) != nullptr) out.push_back(name);
  };
  for (std::string line; std::getline(lines, line);) {
    if (line.find_first_of("\"/") == std::string::npos) continue;
    const std::string code = std::regex_replace(line, comment, "$1");
    for (std::sregex_iterator it(code.begin(), code.end(), literal), end; it != end; ++it)
      take((*it)[1].str());
    for (std::sregex_iterator it(code.begin(), code.end(), tested), end; it != end; ++it) {
      const std::string pattern = (*it)[1].str();
      for (std::sregex_iterator w(pattern.begin(), pattern.end(), word); w != end; ++w)
        take(w->str());
    }
  }
  return out;
}

TEST(EffectRegistry, ASourceTextThatNamesAnEffectIsFound) {
  EXPECT_EQ(effect_names_in("if (entry.name == \"gear_ripple\") return; // \"step\""),
            std::vector<std::string>{"gear_ripple"});
  EXPECT_EQ(effect_names_in("if (/^(drift|two_steps)/.test(effect)) return order;"),
            std::vector<std::string>{"drift"});
  EXPECT_TRUE(
      effect_names_in("/// \"gear_ripple.J2\" and \"step\"\nf(\"a gear_ripple\");").empty());
}

/// Sources of every room but this one, of the programs and of the page.
std::vector<fs::path> sources_of_other_rooms(const fs::path& offline) {
  std::vector<fs::path> out;
  for (fs::recursive_directory_iterator at(offline), end; at != end; ++at) {
    const std::string name = at->path().filename().string(), type = at->path().extension();
    if (name == "node_modules" || at->path() == offline / "effects") at.disable_recursion_pending();
    if (type == ".cpp" || type == ".hpp" || type == ".ts" || type == ".tsx")
      out.push_back(at->path());
  }
  return out;
}

TEST(EffectRegistry, NoOtherRoomNamesAnEffect) {
  const fs::path offline = PLUMB_OFFLINE_SOURCES;
  const auto files = sources_of_other_rooms(offline);
  EXPECT_GT(files.size(), 900U);
  for (const fs::path& file : files) {
    const std::string place = fs::relative(file, offline).generic_string();
    std::ifstream in(file);
    std::stringstream text;
    text << in.rdbuf();
    for (const std::string& name : effect_names_in(text.str()))
      EXPECT_TRUE(means_something_else(place, name))
          << place << " names the effect \"" << name
          << "\": ask the registry (offline/effects/registry.hpp) instead";
  }
}

TEST(EffectRegistry, AnEffectThatMayChangeLaterIsOneOfSingleJoints) {
  int effects = 0;
  for (const EffectDescriptor* effect : effect_descriptors()) {
    EXPECT_FALSE(effect->figure.empty()) << effect->name;
    if (effect->later_change == nullptr) continue;
    ++effects;
    ASSERT_NE(effect->law, nullptr) << effect->name;
    EXPECT_EQ(effect->joints, JointList::kSet) << effect->name;
    EXPECT_GT(effect->later_change->chance, 0.0) << effect->name;
    EXPECT_NE(std::string(effect->later_change->words).find("{}"), std::string::npos);
    for (const char* place : {"{0}", "{1}", "{2}", "{3}"})
      EXPECT_NE(std::string(effect->later_change->sentence).find(place), std::string::npos)
          << effect->name << " " << place;
  }
  EXPECT_GE(effects, 2);
}

}  // namespace
}  // namespace plumb::offline
