// SPDX-License-Identifier: Apache-2.0
#include "diagnose/revision.hpp"

#include "diagnose/unless_refused.hpp"

namespace plumb::offline {
namespace {

bool is_due(Selection& s, const Revision& revision, const Found& subject) {
  if (revision.due != nullptr) return revision.due(s, revision.name, subject);
  return s.first_time(revision.name, s.key(subject.entry));
}

/// Whether the revision has changed the model.
bool revised(Selection& s, const Revision& revision, const Found& subject) {
  std::optional<Proposal> proposal = revision.proposal(s, subject);
  if (!proposal) return false;
  s.take(std::move(*proposal));
  if (revision.afterwards != nullptr) revision.afterwards(s);
  return true;
}

}  // namespace

bool revise(Selection& s, const Revision& revision) {
  for (const Found& subject : revision.subjects(s)) {
    if (!is_due(s, revision, subject)) continue;
    bool done = false;
    if (!unless_refused([&] { done = revised(s, revision, subject); }) &&
        !subject.entry.name.empty())
      s.not_compared_without(subject.entry);
    if (done) return true;
  }
  return false;
}

}  // namespace plumb::offline
