// SPDX-License-Identifier: Apache-2.0
// The table of transitions, against one written by hand for every state and all facts.
#include "plumb/drivers/session_transition.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "plumb/drivers/session_acknowledgement.hpp"
#include "plumb/drivers/session_inputs.hpp"

namespace plumb::drivers {
namespace {

using enum SessionState;

/// The rows of docs/safety.md, from the top: the first that holds.
SessionState by_hand(SessionState from, const SessionFacts& f) {
  const bool fault = f.fault != FaultCause::kNone;
  const bool corrects = f.mode != CorrectionMode::kShadow && !f.stopping;
  const struct {
    bool holds;
    SessionState to;
  } rows[] = {
      {from != kFault && fault, kFault},
      {from == kFault && f.acknowledged && !fault && f.at_zero, kInit},
      {from == kInit && f.heard, kSync},
      {from == kSync && !f.heard, kInit},
      {from == kSync && f.synced, kShadow},
      {from == kShadow && !f.heard, kInit},
      {from == kShadow && f.permitted && !f.lost && corrects, kActive},
      {from == kActive && (f.lost || !corrects), kHold},
      {from == kHold && !f.heard && f.at_zero, kInit},
      {from == kHold && !corrects && f.at_zero, kShadow},
      {from == kHold && f.permitted && !f.lost && corrects, kActive},
  };
  for (const auto& row : rows)
    if (row.holds) return row.to;
  return from;
}

SessionFacts facts_of(unsigned bits, int fault, int mode) {
  return {.fault = static_cast<FaultCause>(fault),
          .heard = (bits & 1U) != 0,
          .synced = (bits & 2U) != 0,
          .permitted = (bits & 4U) != 0,
          .lost = (bits & 8U) != 0,
          .at_zero = (bits & 16U) != 0,
          .acknowledged = (bits & 32U) != 0,
          .stopping = (bits & 64U) != 0,
          .mode = static_cast<CorrectionMode>(mode)};
}

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](char c) {
    return static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  });
  return text;
}

std::string safety_page() {
  std::ifstream in(std::string(PLUMB_SOURCE_DIR) + "/docs/safety.md");
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The cells of a row of a Markdown table.
std::vector<std::string> cells(const std::string& row) {
  std::vector<std::string> out;
  std::istringstream in(row);
  for (std::string cell; std::getline(in, cell, '|');) {
    const std::size_t begin = cell.find_first_not_of(' ');
    if (begin != std::string::npos)
      out.push_back(cell.substr(begin, cell.find_last_not_of(' ') + 1 - begin));
  }
  return out;
}

TEST(SessionTransition, TheRowsOfTheDocumentAreTheTransitionsThatThereAre) {
  using Pair = std::pair<std::string, std::string>;
  std::set<Pair> code, page;
  for (int state = 0; state < 6; ++state)
    for (unsigned bits = 0; bits < 1U << 7U; ++bits)
      for (int fault = 0; fault < 4; ++fault)
        for (int mode = 0; mode < 3; ++mode) {
          const auto from = static_cast<SessionState>(state);
          const SessionState to = next_state(from, facts_of(bits, fault, mode));
          if (to != from) code.emplace(upper(to_string(from)), upper(to_string(to)));
        }
  std::istringstream lines(safety_page());
  bool within = false;
  for (std::string line; std::getline(lines, line);) {
    const auto row = cells(line);
    if (row.size() == 3 && row[0] == "from" && row[1] == "to") within = true;
    if (within && row.empty()) break;
    if (!within || row.size() < 3 || row[0] == "from" || row[0].starts_with("---")) continue;
    if (row[0] != "all but FAULT") page.emplace(row[0], row[1]);
    for (const char* const from : {"INIT", "SYNC", "SHADOW", "ACTIVE", "HOLD"})
      if (row[0] == "all but FAULT") page.emplace(from, row[1]);
  }
  EXPECT_EQ(page, code);
}

TEST(SessionTransition, TheDocumentNamesEveryReasonAndEveryFaultAsTheStatusDoes) {
  const std::string page = safety_page();
  const auto named = [&](const char* word) {
    return page.find("`" + std::string(word) + "`") != std::string::npos;
  };
  for (int i = 0; i < kLostBits; ++i) {
    const char* const word = to_string(static_cast<Lost>(1U << static_cast<unsigned>(i)));
    EXPECT_TRUE(named(word)) << word;
  }
  for (int i = 1; i < kFaultCauses; ++i) {
    const char* const word = to_string(static_cast<FaultCause>(i));
    EXPECT_TRUE(named(word)) << word;
  }
}

TEST(SessionTransition, TheDocumentSaysHowAnAcknowledgementIsPressedAndAskedForAsTheCodeDoes) {
  const std::string page = safety_page();
  const auto said = [&](const std::string& before, double number) {
    const std::size_t at = page.find(before);
    if (at == std::string::npos) return testing::AssertionFailure() << "no \"" << before << "\"";
    const double found = std::strtod(page.c_str() + at + before.size(), nullptr);
    return (std::abs(found - number) < 1e-9 ? testing::AssertionSuccess()
                                            : testing::AssertionFailure())
           << before << found;
  };
  EXPECT_TRUE(said("| FAULT | INIT | acknowledged (the button held for ",
                   1e-9 * AcknowledgeButton::kHeld_ns));
  EXPECT_TRUE(said("the button held for at least ", 1e-9 * AcknowledgeButton::kHeld_ns));
  EXPECT_TRUE(said("without a gap of ", 1e-9 * AcknowledgeButton::kGap_ns));
  EXPECT_TRUE(said("value `status` is then ", kAsksForAcknowledgement));
}

TEST(SessionTransition, IsTheTableForEveryStateAndAllFacts) {
  int seen[6][6] = {};
  for (int state = 0; state < 6; ++state)
    for (unsigned bits = 0; bits < 1U << 7U; ++bits)
      for (int fault = 0; fault < 4; ++fault)
        for (int mode = 0; mode < 3; ++mode) {
          const SessionFacts facts = facts_of(bits, fault, mode);
          const auto from = static_cast<SessionState>(state);
          const SessionState to = next_state(from, facts);
          ASSERT_EQ(to, by_hand(from, facts))
              << state << " " << bits << " " << fault << " " << mode;
          ++seen[state][static_cast<int>(to)];
        }
  // The transitions there are, and no others: 6 that stay, 5 to FAULT, 10 more.
  int kinds = 0;
  for (const auto& row : seen)
    for (const int count : row) kinds += count > 0 ? 1 : 0;
  EXPECT_EQ(kinds, 6 + 5 + 10);
}

TEST(SessionTransition, NoFaultIsLeftWithoutAnAcknowledgement) {
  for (unsigned bits = 0; bits < 1U << 6U; ++bits) {
    const SessionFacts facts{.heard = (bits & 1U) != 0,
                             .synced = (bits & 2U) != 0,
                             .permitted = (bits & 4U) != 0,
                             .lost = (bits & 8U) != 0,
                             .at_zero = (bits & 16U) != 0,
                             .stopping = (bits & 32U) != 0,
                             .mode = CorrectionMode::kFull};
    EXPECT_EQ(next_state(kFault, facts), kFault);
  }
}

TEST(SessionTransition, AnUnknownStateIsAFault) {
  EXPECT_EQ(next_state(static_cast<SessionState>(17), {}), kFault);
}

}  // namespace
}  // namespace plumb::drivers
