#include "core/stats/histogram.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "core/base/error.h"

namespace capstan::stats {
namespace {

using Counts = std::vector<std::uint64_t>;
const std::vector<double> kStackLoss = {42, 37, 37, 28, 18, 18, 19, 20, 15, 14, 14,
                                        13, 11, 12, 8,  7,  8,  8,  9,  15, 15};

// NumPy 1.24: numpy.histogram([-.7,-.2,0,.1,.2,.3,.3,.4,.9,1,1.7], bins=5, range=(0,1)) counts 2 3 1 0 2.
TEST(Histogram, AgreesWithNumPyAndCountsWhatIsOutside) {
  const double infinity = std::numeric_limits<double>::infinity();
  const Histogram h =
      histogram(std::vector<double>{-.7, -.2, 0, .1, .2, .3, .3, .4, .9, 1, 1.7, infinity}, 0, 1, 5);
  EXPECT_EQ(h.counts, (Counts{2, 3, 1, 0, 2}));
  EXPECT_EQ(h.underflow, 2U);
  EXPECT_EQ(h.overflow, 2U);
  EXPECT_EQ(h.total(), 12U);
  EXPECT_EQ(h.edges.front(), 0.0);
  EXPECT_EQ(h.edges.back(), 1.0);
}

// NumPy 1.24: numpy.histogram(x, bins=4, range=(0,50), density=True).
TEST(Histogram, DensityAgreesWithNumPy) {
  const std::vector<double> density = histogram(kStackLoss, 0, 50, 4).density();
  const std::vector<double> expected = {0.02666667, 0.03809524, 0.01142857, 0.00380952};
  ASSERT_EQ(density.size(), expected.size());
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(density[k], expected[k], 5e-9);
}

TEST(Histogram, DensityIsOfAllSamples) {
  const std::vector<double> density = histogram(std::vector<double>{0.5, 5.0}, 0, 2, 2).density();
  EXPECT_EQ(density, (std::vector<double>{0.5, 0.0}));
}

TEST(Histogram, EverySampleIsInTheBinThatItsEdgesName) {
  const double low = -0.3;
  const double high = 1.1;
  const Histogram empty = histogram({}, low, high, 49);
  for (std::size_t k = 0; k + 1 < empty.edges.size(); ++k) {
    const std::vector<double> ends = {empty.edges[k], std::nextafter(empty.edges[k + 1], low)};
    EXPECT_EQ(histogram(ends, low, high, 49).counts[k], 2U) << k;
  }
  EXPECT_EQ(histogram(std::vector<double>{high}, low, high, 49).counts.back(), 1U);
  EXPECT_EQ(empty.density(), std::vector<double>(49, 0.0));
}

// NumPy 1.24: numpy.histogram(x, bins='fd') has edges 7 12 … 42 and counts 6 7 4 0 1 0 3.
TEST(Histogram, FreedmanDiaconisAgreesWithNumPy) {
  const Histogram h = histogramFreedmanDiaconis(kStackLoss);
  EXPECT_EQ(h.counts, (Counts{6, 7, 4, 0, 1, 0, 3}));
  EXPECT_DOUBLE_EQ(h.binWidth(), 5.0);
  EXPECT_EQ(h.edges.front(), 7.0);
}

TEST(Histogram, FreedmanDiaconisStaysWithinItsMost) {
  std::vector<double> values(1000);
  std::iota(values.begin(), values.end(), 0.0);
  values.push_back(1e12);
  EXPECT_EQ(histogramFreedmanDiaconis(values, 64).counts.size(), 64U);
  EXPECT_EQ(histogramFreedmanDiaconis(values, 0).counts.size(), 1U);
}

// 7 of 8 samples coincide: ⌈log2 8⌉ + 1 = 4 bins.
TEST(Histogram, SturgesWhereTheQuartilesCoincide) {
  const Histogram h = histogramFreedmanDiaconis(std::vector<double>{1, 1, 1, 1, 1, 1, 1, 5});
  EXPECT_EQ(h.counts, (Counts{7, 0, 0, 1}));
}

TEST(Histogram, SamplesThatAllCoincideAreOneBin) {
  for (const double x : {0.0, -3.0, 1e17}) {
    const Histogram h = histogramFreedmanDiaconis(std::vector<double>{x, x});
    EXPECT_EQ(h.counts, Counts{2});
    EXPECT_LT(h.edges[0], x);
    EXPECT_GT(h.edges[1], x);
  }
}

TEST(Histogram, NeighbouringDoublesStillHaveAHistogram) {
  const Histogram h = histogramFreedmanDiaconis(std::vector<double>{1.0, std::nextafter(1.0, 2.0)});
  EXPECT_EQ(h.total(), 2U);
  EXPECT_EQ(h.counts.size(), 1U);
}

TEST(Histogram, RefusesWhatHasNoAnswer) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<double> sample = {1.0};
  EXPECT_THROW(histogram(sample, 0, 1, 0), base::InputError);
  EXPECT_THROW(histogram(sample, 1, 1, 3), base::InputError);
  EXPECT_THROW(histogram(sample, 0, infinity, 3), base::InputError);
  EXPECT_THROW(histogram(sample, nan, 1, 3), base::InputError);
  EXPECT_THROW(histogram(sample, 1.0, std::nextafter(1.0, 2.0), 3), base::InputError);
  EXPECT_THROW(histogramFreedmanDiaconis({}), base::InputError);
  EXPECT_THROW(histogramFreedmanDiaconis(std::vector<double>{-1e308, 1e308}), base::InputError);
  try {
    histogram(std::vector<double>{infinity, 0.5, nan}, 0, 1, 3);
    FAIL();
  } catch (const base::InputError& error) {
    EXPECT_EQ(error.fault().key, "histogram[2]");
  }
}

}  // namespace
}  // namespace capstan::stats
