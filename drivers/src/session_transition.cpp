// SPDX-License-Identifier: Apache-2.0
#include "plumb/drivers/session_transition.hpp"

namespace plumb::drivers {
namespace {

bool may_correct(const SessionFacts& facts) noexcept {
  return facts.permitted && !facts.lost && facts.mode != CorrectionMode::kShadow && !facts.stopping;
}

SessionState from_active(const SessionFacts& facts) noexcept {
  const bool goes_on = !facts.lost && facts.mode != CorrectionMode::kShadow && !facts.stopping;
  return goes_on ? SessionState::kActive : SessionState::kHold;
}

SessionState from_hold(const SessionFacts& facts) noexcept {
  if (facts.at_zero && !facts.heard) return SessionState::kInit;
  if (facts.at_zero && (facts.mode == CorrectionMode::kShadow || facts.stopping))
    return SessionState::kShadow;
  return may_correct(facts) ? SessionState::kActive : SessionState::kHold;
}

}  // namespace

SessionState next_state(SessionState state, const SessionFacts& facts) noexcept {
  const bool fault = facts.fault != FaultCause::kNone;
  if (state == SessionState::kFault)
    return facts.acknowledged && !fault && facts.at_zero ? SessionState::kInit : state;
  if (fault) return SessionState::kFault;
  switch (state) {
    case SessionState::kInit:
      return facts.heard ? SessionState::kSync : state;
    case SessionState::kSync:
      if (!facts.heard) return SessionState::kInit;
      return facts.synced ? SessionState::kShadow : state;
    case SessionState::kShadow:
      if (!facts.heard) return SessionState::kInit;
      return may_correct(facts) ? SessionState::kActive : state;
    case SessionState::kActive:
      return from_active(facts);
    case SessionState::kHold:
      return from_hold(facts);
    case SessionState::kFault:
      break;
  }
  return SessionState::kFault;
}

const char* to_string(SessionState state) noexcept {
  switch (state) {
    case SessionState::kInit:
      return "init";
    case SessionState::kSync:
      return "sync";
    case SessionState::kShadow:
      return "shadow";
    case SessionState::kActive:
      return "active";
    case SessionState::kHold:
      return "hold";
    case SessionState::kFault:
      return "fault";
  }
  return "unknown";
}

const char* to_string(FaultCause cause) noexcept {
  switch (cause) {
    case FaultCause::kNone:
      return "none";
    case FaultCause::kPoseMismatch:
      return "pose-mismatch";
    case FaultCause::kOtherRobot:
      return "other-robot";
    case FaultCause::kForeignSender:
      return "foreign-sender";
  }
  return "unknown";
}

const char* to_string(CorrectionMode mode) noexcept {
  switch (mode) {
    case CorrectionMode::kShadow:
      return "shadow";
    case CorrectionMode::kLimited:
      return "limited";
    case CorrectionMode::kFull:
      return "full";
  }
  return "unknown";
}

}  // namespace plumb::drivers
