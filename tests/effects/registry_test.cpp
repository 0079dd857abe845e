// SPDX-License-Identifier: Apache-2.0
#include "effects/registry.hpp"

#include <gtest/gtest.h>

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

/// A string literal that is the name of an effect but means something else in that file.
struct OtherMeaning {
  const char* file;
  const char* literal;
};
constexpr OtherMeaning kOtherMeanings[] = {
    {"check/data_sense.cpp", "tracker"},        // the value of a comment "# frame: tracker"
    {"check/row_pattern.cpp", "tracker"},       // the instrument, in a sentence
    {"check/convention_words.cpp", "tracker"},  // the end of a sentence
    {"fit/model_json.cpp", "formula"},          // a key of the run's JSON file
};

/// String literals of a source text that are names of effects, outside of comments.
std::vector<std::string> effect_names_in(const std::string& source) {
  std::vector<std::string> out;
  std::istringstream lines(source);
  const std::regex literal("\"((?:[^\"\\\\]|\\\\.)*)\"");
  for (std::string line; std::getline(lines, line);) {
    const std::string code = std::regex_replace(line, std::regex("(^|[^:\"])//.*"), "$1");
    for (std::sregex_iterator it(code.begin(), code.end(), literal), end; it != end; ++it)
      if (find_descriptor((*it)[1].str()) != nullptr) out.push_back((*it)[1].str());
  }
  return out;
}

TEST(EffectRegistry, ASourceTextThatNamesAnEffectIsFound) {
  EXPECT_EQ(effect_names_in("if (entry.name == \"gear_ripple\") return; // \"step\""),
            std::vector<std::string>{"gear_ripple"});
  EXPECT_TRUE(
      effect_names_in("/// \"gear_ripple.J2\" and \"step\"\nf(\"a gear_ripple\");").empty());
}

TEST(EffectRegistry, NoOtherRoomNamesAnEffect) {
  const fs::path offline = PLUMB_OFFLINE_SOURCES;
  int files = 0;
  for (const char* room : {"check", "diagnose", "fit"}) {
    for (const auto& file : fs::directory_iterator(offline / room)) {
      const std::string end = file.path().extension();
      if (end != ".cpp" && end != ".hpp") continue;
      ++files;
      const std::string place = fs::relative(file.path(), offline).generic_string();
      std::ifstream in(file.path());
      std::stringstream text;
      text << in.rdbuf();
      for (const std::string& name : effect_names_in(text.str())) {
        bool other = false;
        for (const auto& [allowed_in, literal] : kOtherMeanings)
          other = other || (place == allowed_in && name == literal);
        EXPECT_TRUE(other) << place << " names the effect \"" << name
                           << "\": ask the registry (offline/effects/registry.hpp) instead";
      }
    }
  }
  EXPECT_GT(files, 100);
}

}  // namespace
}  // namespace plumb::offline
