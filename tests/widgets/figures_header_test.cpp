#include <gtest/gtest.h>

#include <limits>

#include "tests/widgets/picture.h"
#include "tests/widgets/synthetic_motion.h"
#include "widgets/figures/joint_figure.h"
#include "widgets/figures/number_text.h"

namespace capstan::widgets {
namespace {

/// The rows of a figure of some width with the widest numbers that the columns score_test to hold.
class HeaderTest : public testing::TestWithParam<int> {
 protected:
  HeaderTest() : figure_(history_) {
    for (int ms = 0; ms < 2000; ms += 5) history_.append(syntheticSnapshot(1000.0 + ms * 1e-3));
    figure_.setJointNames({"shoulder", "elbow", "insertion"});
    figure_.resize(GetParam(), 740);
    figure_.refresh(true);
    figure_.refresh(true);
    for (int i = 0; i < 3; ++i) {
      FigureHeader& header = *figure_.plot(i).header();
      for (const auto quantity : {Quantity::kTrue, Quantity::kKinematic, Quantity::kCamera, Quantity::kUkf})
        header.setValue(quantity, valueText(i == 1 ? -234.56 : -0.5));
      header.setSigma(sigmaText(i == 1 ? 45.67 : 0.01));
    }
    rows_ = {figure_.legend().texts()};
    for (int i = 0; i < 3; ++i) rows_.push_back(figure_.plot(i).header()->texts());
  }

  JointHistory history_{4096};
  JointFigure figure_;
  std::vector<std::vector<FigureHeader::Text>> rows_;
};

TEST_P(HeaderTest, TextsNeitherOverlapNorLeaveTheFigure) {
  for (const auto& row : rows_) {
    ASSERT_GE(row.size(), 5U);
    for (std::size_t i = 0; i < row.size(); ++i) {
      EXPECT_GE(row[i].box.left(), 0.0) << row[i].text.toStdString();
      EXPECT_LE(row[i].box.right(), GetParam()) << row[i].text.toStdString();
      EXPECT_FALSE(row[i].text.contains("…")) << row[i].text.toStdString();
      for (std::size_t k = 0; k < i; ++k)
        EXPECT_FALSE(row[i].box.adjusted(-4, 1, 4, -1).intersects(row[k].box))
            << row[k].text.toStdString() << " | " << row[i].text.toStdString();
    }
  }
}

TEST_P(HeaderTest, DecimalsStandBelowEachOtherAndTheLastUnderTheAxesEnd) {
  for (std::size_t row = 1; row < rows_.size(); ++row) {
    ASSERT_EQ(rows_[row].size(), rows_[0].size());
    for (std::size_t i = 1; i < rows_[row].size(); ++i) {
      EXPECT_DOUBLE_EQ(rows_[row][i].box.right(), rows_[0][i].box.right());
      EXPECT_EQ(rows_[row][i].text.section('.', 1).size(), 2);
    }
    EXPECT_NEAR(rows_[row].back().box.right(), figure_.plot(0).axes()->right(), 1.5);
  }
}

TEST_P(HeaderTest, RowsStandAboveTheirAxes) {
  for (int i = 0; i < 3; ++i)
    for (const auto& text : figure_.plot(i).header()->texts()) {
      EXPECT_LE(text.box.bottom(), figure_.plot(i).axes()->top());
      EXPECT_GE(text.box.top(), i > 0 ? figure_.plot(i - 1).axes()->bottom() : 0);
    }
}

TEST_P(HeaderTest, TitleCarriesTheUnitOnce) {
  EXPECT_EQ(rows_[1][0].text, "shoulder q1 [deg]");
  EXPECT_EQ(rows_[3][0].text, "insertion q3 [mm]");
  EXPECT_TRUE(figure_.plot(0).axes()->axis(QCPAxis::atLeft)->label().isEmpty());
}

INSTANTIATE_TEST_SUITE_P(Widths, HeaderTest,
                         testing::Values(380, 420, 460, 500, 560, 640, 740, 830, 1000, 1200, 1400));

TEST(NumberText, StaysWithinItsColumn) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double size :
       {0.0, 0.004, 9.999, 99.994, 99.996, 999.994, 999.996, 9999.4, 99999.6, 3e7, 2e22}) {
    EXPECT_LE(valueText(-size).size(), kWidestValue.size()) << size;
    EXPECT_LE(sigmaText(size).size(), kWidestSigma.size()) << size;
  }
  EXPECT_EQ(valueText(-27.414), QString::fromUtf8("−27.41")) << "a real minus sign";
  EXPECT_EQ(sigmaText(0.084), QString::fromUtf8("±0.08"));
  EXPECT_EQ(valueText(nan), QString::fromUtf8("—"));
  EXPECT_EQ(sigmaText(nan), QString::fromUtf8("—"));
}

}  // namespace
}  // namespace capstan::widgets
