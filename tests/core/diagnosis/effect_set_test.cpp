// Sets of effects: sorted, each effect once, and what counts as an exchange.
#include "core/diagnosis/selection/effect_set.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace capstan::diagnosis {
namespace {

EffectCandidate at(std::string_view name, int joint) { return {hypothesisNamed(name), joint}; }

TEST(EffectSet, IsSortedWhateverTheOrderInWhichEffectsCame) {
  const EffectCandidate a = at("backlash", 2), b = at("homing_offset", 1), c = at("homing_offset", 3);
  std::vector<EffectCandidate> order = {a, b, c};
  std::ranges::sort(order);
  const EffectSet sorted = order;
  do {
    EffectSet set;
    for (const EffectCandidate& one : order) set = plus(std::move(set), one);
    EXPECT_EQ(set, sorted);
  } while (std::ranges::next_permutation(order).found);
}

TEST(EffectSet, HasEachEffectOnceAndJointsApart) {
  const EffectSet one = plus(EffectSet(), at("backlash", 2));
  EXPECT_EQ(plus(one, at("backlash", 2)), one);
  const EffectSet two = plus(one, at("backlash", 3));
  EXPECT_EQ(two.size(), 2U);
  EXPECT_TRUE(contains(two, at("backlash", 2)));
  EXPECT_TRUE(contains(two, at("backlash", 3)));
  EXPECT_FALSE(contains(two, at("backlash", 1)));
  EXPECT_FALSE(contains(EffectSet(), at("backlash", 2)));
}

TEST(EffectSet, TakesAwayWhatItHasAndNothingElse) {
  const EffectSet two = plus(plus(EffectSet(), at("slack", 1)), at("payload", 0));
  EXPECT_EQ(minus(two, at("slack", 1)), plus(EffectSet(), at("payload", 0)));
  EXPECT_EQ(minus(two, at("slack", 2)), two);
  EXPECT_TRUE(minus(minus(two, at("slack", 1)), at("payload", 0)).empty());
}

}  // namespace
}  // namespace capstan::diagnosis
