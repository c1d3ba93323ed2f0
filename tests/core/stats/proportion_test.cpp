#include "core/stats/proportion.h"

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace capstan::stats {
namespace {

// The four examples of Newcombe (1998), Table I: Wilson 0.2553–0.3662, 0.0624–0.1605, 0–0.1611,
// 0.0061–0.1718, Clopper and Pearson 0.2527–0.3676, 0.0578–0.1617, 0–0.1684, 0.0009–0.1776. More digits from
// R 4.2.2: prop.test(k, n, correct=FALSE)$conf.int and binom.test(k, n)$conf.int.
struct Row {
  std::uint64_t hits, trials;
  Interval wilson, clopper_pearson;
};
const Row kRows[] = {
    {81, 263, {0.2552885198782743, 0.3662095769828002}, {0.2527367455852712, 0.3676219226013514}},
    {15, 148, {0.06238639953073628, 0.16048724172330800}, {0.05784401008344855, 0.16165049034947898}},
    {0, 20, {0.0, 0.1611251580528193}, {0.0, 0.1684334709830854}},
    {1, 29, {0.006113214292762661, 0.171755218793202824}, {0.0008726468835799228, 0.1776442954887228476}}};

TEST(Proportion, AgreesWithNewcombeAndR) {
  for (const Row& row : kRows) {
    const Interval wilson = wilsonInterval(row.hits, row.trials);
    EXPECT_NEAR(wilson.low, row.wilson.low, 1e-14);
    EXPECT_NEAR(wilson.high, row.wilson.high, 1e-14);
    const Interval exact = clopperPearsonInterval(row.hits, row.trials);
    EXPECT_NEAR(exact.low, row.clopper_pearson.low, 1e-13);
    EXPECT_NEAR(exact.high, row.clopper_pearson.high, 1e-13);
  }
}

// R 4.2.2: as above with 29 of 29 and conf.level=0.9.
TEST(Proportion, AllHitsReachOne) {
  EXPECT_NEAR(wilsonInterval(29, 29, 0.9).low, 0.9146665485165832, 1e-14);
  EXPECT_EQ(wilsonInterval(29, 29, 0.9).high, 1.0);
  EXPECT_NEAR(clopperPearsonInterval(29, 29, 0.9).low, 0.9018553723227043, 1e-13);
  EXPECT_EQ(clopperPearsonInterval(29, 29, 0.9).high, 1.0);
}

TEST(Proportion, RefusesWhatHasNoAnswer) {
  EXPECT_THROW(wilsonInterval(0, 0), base::InputError);
  EXPECT_THROW(clopperPearsonInterval(3, 2), base::InputError);
  EXPECT_THROW(wilsonInterval(1, 2, 0.0), base::InputError);
  EXPECT_THROW(clopperPearsonInterval(1, 2, 1.0), base::InputError);
}

}  // namespace
}  // namespace capstan::stats
