// SPDX-License-Identifier: Apache-2.0
// The table of transitions, against one written by hand for every state and all facts.
#include "plumb/drivers/session_transition.hpp"

#include <gtest/gtest.h>

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

TEST(SessionTransition, IsTheTableForEveryStateAndAllFacts) {
  int seen[6][6] = {};
  for (int state = 0; state < 6; ++state)
    for (unsigned bits = 0; bits < 1U << 7U; ++bits)
      for (int fault = 0; fault < 4; ++fault)
        for (int mode = 0; mode < 3; ++mode) {
          const SessionFacts facts{.fault = static_cast<FaultCause>(fault),
                                   .heard = (bits & 1U) != 0,
                                   .synced = (bits & 2U) != 0,
                                   .permitted = (bits & 4U) != 0,
                                   .lost = (bits & 8U) != 0,
                                   .at_zero = (bits & 16U) != 0,
                                   .acknowledged = (bits & 32U) != 0,
                                   .stopping = (bits & 64U) != 0,
                                   .mode = static_cast<CorrectionMode>(mode)};
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
