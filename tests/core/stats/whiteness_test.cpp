#include "core/stats/whiteness.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/stats/proportion.h"
#include "tests/core/stats/michelson.h"

namespace capstan::stats {
namespace {

// r_1 is certified by NIST StRD; r_2, r_3: R 4.2.2, acf(x, plot=FALSE, lag.max=3)$acf.
TEST(Whiteness, AutocorrelationOfMichelsonIsNists) {
  const std::vector<double> r = autocorrelation(kMichelson, 3);
  ASSERT_EQ(r.size(), 4U);
  EXPECT_EQ(r[0], 1.0);
  EXPECT_NEAR(r[1], 0.535199668621283, 1e-12);
  EXPECT_NEAR(r[2], 0.14805327948426891, 1e-12);
  EXPECT_NEAR(r[3], -0.02330860937435569, 1e-12);
}

// R 4.2.2: q <- Box.test(x, lag=h, type="Ljung-Box")$statistic; pchisq(q, h - fitted, lower.tail=FALSE).
// (Box.test's own P is one less the other tail and has lost digits.)
TEST(Whiteness, LjungBoxAgreesWithR) {
  struct Row {
    std::size_t lags, fitted;
    double q, p;
  };
  for (const Row& row : {Row{1, 0, 29.51186454526826, 5.5575450395865603e-08},
                         Row{5, 0, 32.47300257818918, 4.7879842377238913e-06},
                         Row{10, 0, 39.72610685344012, 1.8933417532918186e-05},
                         Row{10, 2, 39.72610685344012, 3.6028474688370522e-06}}) {
    const LjungBox test = ljungBox(kMichelson, row.lags, row.fitted);
    EXPECT_NEAR(test.q, row.q, 1e-10);
    EXPECT_EQ(test.degrees_of_freedom, static_cast<double>(row.lags - row.fitted));
    EXPECT_NEAR(test.p_value / row.p, 1.0, 1e-10);
  }
}

TEST(Whiteness, AlternatingSamplesAreAntiCorrelated) {
  std::vector<double> values;
  for (int k = 0; k < 50; ++k) values.insert(values.end(), {-1.0, 1.0});
  const std::vector<double> r = autocorrelation(values, 2);
  EXPECT_DOUBLE_EQ(r[1], -0.99);
  EXPECT_DOUBLE_EQ(r[2], 0.98);
}

// At 5 % the test must refuse about 5 % of recordings that are white.
TEST(Whiteness, RefusesAsManyWhiteRecordingsAsItSays) {
  base::Random random(7, "whiteness");
  std::uint64_t refused = 0;
  std::vector<double> values(300);
  for (int run = 0; run < 2000; ++run) {
    for (double& x : values) x = random.normal();
    if (ljungBox(values, 10).p_value < 0.05) ++refused;
  }
  EXPECT_TRUE(clopperPearsonInterval(refused, 2000, 0.999).contains(0.05)) << refused;
}

TEST(Whiteness, RefusesWhatHasNoAnswer) {
  const std::vector<double> four = {1.0, 2.0, 4.0, 3.0};
  EXPECT_THROW(autocorrelation(four, 4), base::InputError);
  EXPECT_THROW(autocorrelation({}, 0), base::InputError);
  EXPECT_THROW(autocorrelation(std::vector<double>{0.1, 0.1, 0.1}, 1), base::InputError);
  EXPECT_THROW(ljungBox(four, 0), base::InputError);
  EXPECT_THROW(ljungBox(four, 2, 2), base::InputError);
  EXPECT_THROW(ljungBox(std::vector<double>{1.0, std::numeric_limits<double>::quiet_NaN(), 2.0}, 1),
               base::InputError);
  EXPECT_NO_THROW(ljungBox(four, 3));
}

}  // namespace
}  // namespace capstan::stats
