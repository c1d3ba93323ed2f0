#include "core/stats/boxplot.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "core/base/error.h"

namespace capstan::stats {
namespace {

// R 4.2.2: boxplot.stats(stackloss$stack.loss) gives $stats 7 11 15 19 28, $n 21, $out 42 37 37. (R's hinges
// are the type 7 quartiles for n = 4k + 1.)
TEST(Boxplot, AgreesWithROnStackLoss) {
  const Boxplot box = boxplot(
      std::vector<double>{42, 37, 37, 28, 18, 18, 19, 20, 15, 14, 14, 13, 11, 12, 8, 7, 8, 8, 9, 15, 15});
  EXPECT_EQ(box.n, 21U);
  EXPECT_EQ(box.lower_whisker, 7.0);
  EXPECT_EQ(box.first_quartile, 11.0);
  EXPECT_EQ(box.median, 15.0);
  EXPECT_EQ(box.third_quartile, 19.0);
  EXPECT_EQ(box.upper_whisker, 28.0);
  EXPECT_EQ(box.outliers, (std::vector<double>{37, 37, 42}));
  EXPECT_EQ(box.interquartileRange(), 8.0);
}

// R 4.2.2: quantile(precip[1:4]) gives 38.125, 51.6, 57.775 of 67.0 54.7 7.0 48.5.
TEST(Boxplot, QuartilesAreType7) {
  const Boxplot box = boxplot(std::vector<double>{67.0, 54.7, 7.0, 48.5});
  EXPECT_DOUBLE_EQ(box.first_quartile, 38.125);
  EXPECT_DOUBLE_EQ(box.median, 51.6);
  EXPECT_DOUBLE_EQ(box.third_quartile, 57.775);
}

TEST(Boxplot, SamplesOnTheFenceAreInside) {
  // Quartiles 2, 3, 4: fences −1 and 7.
  const Boxplot box = boxplot(std::vector<double>{-1, 2, 3, 4, 7});
  EXPECT_EQ(box.lower_whisker, -1.0);
  EXPECT_EQ(box.upper_whisker, 7.0);
  EXPECT_TRUE(box.outliers.empty());
}

// Q1 = −25 lies between the outlier −100 (fence −62.5) and the other samples at 0, which is in the box.
TEST(Boxplot, WhiskersDoNotReachIntoTheBox) {
  const Boxplot box = boxplot(std::vector<double>{-100, 0, 0, 0});
  EXPECT_EQ(box.first_quartile, -25.0);
  EXPECT_EQ(box.lower_whisker, -25.0);
  EXPECT_EQ(box.outliers, (std::vector<double>{-100}));
}

TEST(Boxplot, OneSampleIsAllOfIt) {
  const Boxplot box = boxplot(std::vector<double>{4.0});
  EXPECT_EQ(box.lower_whisker, 4.0);
  EXPECT_EQ(box.median, 4.0);
  EXPECT_EQ(box.upper_whisker, 4.0);
}

TEST(Boxplot, RefusesWhatHasNoAnswer) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(boxplot({}), base::InputError);
  EXPECT_THROW(boxplot(std::vector<double>{1.0, nan}), base::InputError);
  EXPECT_THROW(boxplot(std::vector<double>{1.0, 2.0}, -1.0), base::InputError);
  EXPECT_THROW(boxplot(std::vector<double>{1.0, 2.0}, nan), base::InputError);
}

}  // namespace
}  // namespace capstan::stats
