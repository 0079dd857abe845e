// SPDX-License-Identifier: Apache-2.0
// A selection owns what its whitened fit refers to, and takes only a refused refit for an answer.
#include "diagnose/selection.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "diagnose/revision.hpp"
#include "diagnose/unless_refused.hpp"
#include "tests/diagnose/begun.hpp"

namespace plumb::offline {
namespace {

BlindRequest yielding() {
  BlindRequest out;
  out.poses = 120;
  out.fresh_poses = 1;
  out.effects = {"joint_compliance:J2:5"};
  return out;
}

TEST(Selection, RefersToItsOwnCellWhereverItGoes) {
  const BlindCase blind = make_blind_case(yielding());
  Selection first = begun(blind);
  EXPECT_EQ(first.whitened().cell, &first.cell());
  ASSERT_NE(first.look().supported(), nullptr);
  const EffectEntry best = first.look().supported()->entry;

  Selection second = std::move(first);
  EXPECT_EQ(second.whitened().cell, &second.cell());
  second.look_at(second.fitted({best}));
  EXPECT_EQ(second.whitened().cell, &second.cell());
  ASSERT_EQ(second.cell().effects.size(), 1U);
  EXPECT_EQ(second.cell().effects.front().name, best.name);

  JudgedModel without = second.without(best, {});
  const JudgedModel copy = without;
  EXPECT_EQ(copy.whitened.cell, copy.model.cell.get());
  EXPECT_NE(copy.whitened.cell, &second.cell());
  second.go_to(std::move(without));
  EXPECT_EQ(second.whitened().cell, &second.cell());
  EXPECT_TRUE(second.cell().effects.empty());
  EXPECT_EQ(second.seen().size(), 2U);
}

TEST(Selection, LooksAgainWithoutWhatIsBanned) {
  const BlindCase blind = make_blind_case(yielding());
  Selection selection = begun(blind);
  const std::string best = selection.key(selection.look().library.front().entry);
  selection.look_again();
  EXPECT_EQ(selection.key(selection.look().library.front().entry), best);
  selection.ban(best);
  selection.look_again();
  EXPECT_NE(selection.key(selection.look().library.front().entry), best);
}

std::vector<Found> best_of_the_scan(const Selection& s) { return {s.look().library.front()}; }

std::optional<Proposal> with_it(const Selection& s, const Found& found) {
  return Proposal{.model = s.fitted({found.entry}),
                  .in = {found},
                  .instead = std::vector<Alternative>(2),
                  .banned = {"banned"}};
}

std::optional<Proposal> refused(const Selection&, const Found&) {
  throw Failure(Exit::kNumbersSayNo, Problem{.code = "E-TEST", .message = "a test"});
}

TEST(Revision, IsTriedOnceWithEachEffectAndTakenWhole) {
  const BlindCase blind = make_blind_case(yielding());
  Selection s = begun(blind);
  const Found best = s.look().library.front();
  EXPECT_FALSE(revise(s, {.name = "a", .subjects = best_of_the_scan, .proposal = refused}));
  EXPECT_EQ(s.not_judged().size(), 1U);
  EXPECT_TRUE(s.added.empty());
  EXPECT_FALSE(revise(s, {.name = "a", .subjects = best_of_the_scan, .proposal = with_it}));
  EXPECT_TRUE(revise(s, {.name = "b", .subjects = best_of_the_scan, .proposal = with_it}));
  EXPECT_EQ(s.cell().effects.size(), 1U);
  ASSERT_EQ(s.added.size(), 1U);
  EXPECT_EQ(s.key(s.added.front().entry), s.key(best.entry));
  EXPECT_EQ(s.alternatives_of(s.key(best.entry)).size(), 2U);
  EXPECT_EQ(s.banned(), std::vector<std::string>{"banned"});
}

TEST(Selection, RemembersWhatWasDoneInWhichState) {
  const BlindCase blind = make_blind_case(yielding());
  Selection s = begun(blind);
  EXPECT_TRUE(s.first_time("a", "J1"));
  EXPECT_FALSE(s.first_time("a", "J1"));
  EXPECT_TRUE(s.first_time("a", "J2", 3));
  EXPECT_TRUE(s.first_time("a", "J2", 4));
  EXPECT_FALSE(s.first_time("a", "J2", 4));
  EXPECT_TRUE(s.first_time("b", "J1"));
  EXPECT_EQ(s.times("a"), 2U);
  EXPECT_EQ(s.times("c"), 0U);
}

TEST(UnlessRefused, TakesOnlyNumbersThatSayNoForAnAnswer) {
  const Problem problem{.code = "E-TEST", .message = "a test"};
  EXPECT_TRUE(unless_refused([] {}));
  EXPECT_FALSE(unless_refused([&] { throw Failure(Exit::kNumbersSayNo, problem); }));
  for (const Exit exit : {Exit::kInput, Exit::kUsage, Exit::kEnvironment})
    EXPECT_THROW(unless_refused([&] { throw Failure(exit, problem); }), Failure);
  EXPECT_THROW(unless_refused([] { throw std::bad_alloc(); }), std::bad_alloc);
  EXPECT_THROW(unless_refused([] { throw std::logic_error("a fault"); }), std::logic_error);
}

}  // namespace
}  // namespace plumb::offline
