#include <gtest/gtest.h>

#include <QTemporaryDir>
#include <cmath>
#include <numbers>

#include "core/diagnosis/report/shown.h"
#include "core/stats/rms.h"
#include "tests/support/sample_diagnosis.h"
#include "tests/widgets/picture.h"
#include "widgets/figures/residual_figure.h"
#include "widgets/figures/save_plot.h"
#include "widgets/figures/signature_figure.h"

/// What a diagnosis draws: signatures and residuals, before and after.
namespace capstan::widgets {
namespace {

using diagnosis::Report;
using diagnosis::Verdict;
using testing::sampleReport;

constexpr std::size_t kElbow = 1;  ///< channel of the joint with the backlash

std::vector<QStringList> rowsOf(const Figure& figure, const std::string& suffix) {
  std::vector<QStringList> rows;
  for (const FigureNumbers& numbers : figure.numbers())
    if (numbers.suffix == suffix)
      for (const QString& line : QString::fromStdString(numbers.csv).split('\n', Qt::SkipEmptyParts))
        rows.push_back(line.split(','));
  if (!rows.empty()) rows.erase(rows.begin());
  return rows;
}

QString wordsAbove(const PanelFigure& figure, std::size_t panel) {
  QString text;
  for (const TextRow::Line& line : figure.panels()[panel].header->lines()) text += line.text + '\n';
  return text.replace(QChar(0x00A0), ' ');
}

std::size_t withVariable(const diagnosis::ChannelReport& channel, const std::string& variable) {
  for (std::size_t i = 0; i < channel.before.size(); ++i)
    if (channel.before[i].variable == variable) return i;
  return channel.before.size();
}

TEST(SignatureFigures, ShowBinsInDegreesBeforeAndAfter) {
  const Report report = sampleReport();
  const auto& channel = report.channels[kElbow];
  const SignatureFigure figure({"q2", {}, {signaturePanel(channel, 0, true)}});
  const diagnosis::Signature& shown = channel.before[0];
  ASSERT_EQ(figure.before(0)->data()->size(), static_cast<int>(shown.bins.size()));
  const double degrees = 180.0 / std::numbers::pi;
  for (int i = 0; i < figure.before(0)->data()->size(); ++i)
    EXPECT_NEAR(figure.before(0)->data()->at(i)->value,
                degrees * shown.bins[static_cast<std::size_t>(i)].mean, 1e-12);
  ASSERT_NE(figure.after(0), nullptr);
  EXPECT_TRUE(figure.panels()[0].y_label.contains("[deg]"));
  EXPECT_TRUE(wordsAbove(figure, 0).contains("% of the variance")) << wordsAbove(figure, 0).toStdString();
  const auto rows = rowsOf(figure, "");
  ASSERT_EQ(rows.size(), shown.bins.size() +
                             channel.after[withVariable(channel, shown.variable)].bins.size() -
                             (channel.after[0].bins.empty() ? 1 : 0));
  EXPECT_EQ(rows[0][4], "refitted");
  EXPECT_EQ(rows[0][8].toDouble(), degrees * shown.bins[0].mean);
  EXPECT_EQ(rowsOf(figure, "_summary")[0][3].toDouble(), shown.share);
}

TEST(SignatureFigures, DirectionsAreWords) {
  const Report report = sampleReport();
  const auto& channel = report.channels[kElbow];
  const std::size_t direction = withVariable(channel, "direction of joint 2");
  ASSERT_LT(direction, channel.before.size());
  SignatureFigure figure({"q2", {}, {signaturePanel(channel, direction, true)}});
  figure.resize(600, 400);
  figure.replot();
  const auto labels = figure.panels()[0].axes->axis(QCPAxis::atBottom)->tickVectorLabels();
  EXPECT_EQ(labels, (QVector<QString>{"backwards", "at rest", "forwards"}));
  const auto points = figure.before(0)->data();
  EXPECT_GT(points->at(0)->value, 0.5) << "a play holds it back: it stays ahead when it moves back [deg]";
  EXPECT_LT((points->constEnd() - 1)->value, -0.5);
  const auto left = figure.after(0)->data();
  EXPECT_LT(std::abs(left->at(0)->value), 0.1 * points->at(0)->value) << "gone with the cause in the model";
}

TEST(SignatureFigures, StrongestFirstOnOneScaleAndNothingAfterWithoutACause) {
  const Report report = sampleReport();
  const SignatureFigure figure(strongestSignatures(report, report.channels[kElbow], 4));
  ASSERT_GE(figure.data().panels.size(), 2U);
  EXPECT_GE(figure.data().panels[0].before.share, figure.data().panels[1].before.share);
  EXPECT_EQ(figure.panels()[0].axes->axis(QCPAxis::atLeft)->range(),
            figure.panels()[1].axes->axis(QCPAxis::atLeft)->range());
  for (const PanelFigure::Panel& panel : figure.panels())
    EXPECT_EQ(panel.axes->axis(QCPAxis::atBottom)->label(), panel.x_label) << "each has its own variable";
  std::size_t torques = 0;
  for (const SignaturePanel& panel : figure.data().panels)
    torques += panel.before.variable.find("torque") != std::string::npos ||
               panel.before.variable.find("stretch") != std::string::npos;
  EXPECT_LE(torques, 1U) << "they go together";
  const Report none = sampleReport({.verdict = Verdict::kNothing});
  const SignatureFigure quiet(strongestSignatures(none, none.channels[kElbow], 4));
  ASSERT_GE(quiet.data().panels.size(), 1U);
  EXPECT_EQ(quiet.after(0), nullptr);
  EXPECT_EQ(quiet.legend().entries().size(), 2U) << "before, and the sensor's noise";
  const double noise = diagnosis::shownUnit("rad").scale * none.channels[kElbow].refitted.noise;
  ASSERT_GT(noise, 0.0);
  const QCPRange axis = quiet.panels()[0].axes->axis(QCPAxis::atLeft)->range();
  EXPECT_TRUE(axis.contains(noise) && axis.contains(-noise)) << "nothing does not fill the picture";
}

TEST(SignatureFigures, BarsStayWithinTheAxisAndUnknownIntervalsHaveNone) {
  Report report = sampleReport();
  diagnosis::Signature& first = report.channels[kElbow].before[0];
  const double far = 1e3;
  first.bins[0].interval = {-far, far};
  first.bins[1].interval = {std::nan(""), std::nan("")};
  const SignatureFigure figure({"q2", {}, {signaturePanel(report.channels[kElbow], 0, false)}});
  const QCPRange axis = figure.panels()[0].axes->axis(QCPAxis::atLeft)->range();
  EXPECT_LT(axis.size(), 20.0) << "[deg]: a wild interval does not take the axis";
  const auto* bars = figure.findChild<QCPErrorBars*>();
  ASSERT_NE(bars, nullptr);
  const double mean = figure.before(0)->data()->at(0)->value;
  EXPECT_NEAR(mean + bars->data()->at(0).errorPlus, axis.upper, 1e-9);
  EXPECT_EQ(bars->data()->at(1).errorPlus, 0.0);
}

TEST(ResidualFigures, ShowTheNumbersOfTheReport) {
  const Report report = sampleReport();
  const auto& channel = report.channels[kElbow];
  const ResidualFigure figure(residualData(report, channel));
  const auto summary = rowsOf(figure, "_summary");
  ASSERT_EQ(summary.size(), 3U);
  EXPECT_EQ(summary[1][2], "refitted");
  const double degrees = 180.0 / std::numbers::pi;
  EXPECT_EQ(summary[1][3].toDouble(), degrees * stats::rms(channel.refitted.residual));
  const auto rows = rowsOf(figure, "");
  EXPECT_EQ(rows.size(), channel.refitted.size());
  EXPECT_EQ(rows[10][3].toDouble() - rows[10][5].toDouble(),
            degrees * channel.refitted.measured[10] - degrees * channel.refitted.simulated[10]);
  EXPECT_EQ(rows[10][3].toDouble(), degrees * channel.refitted.measured[10]);
  EXPECT_TRUE(wordsAbove(figure, 1).contains("extended")) << wordsAbove(figure, 1).toStdString();
  EXPECT_TRUE(figure.caption().contains("slow.csv"));
  EXPECT_TRUE(figure.caption().contains("of what the recorded signals can explain of the residual of q2"))
      << figure.caption().toStdString();
  EXPECT_TRUE(SignatureFigure(strongestSignatures(report, channel)).caption().contains("recorded signals"));
}

TEST(ResidualFigures, LongRecordingsLeaveAFewThousandRows) {
  const Report report = sampleReport({.duration = 60.0});
  const ResidualFigure figure(residualData(report, report.channels[0]));
  const std::size_t rows = rowsOf(figure, "").size();
  EXPECT_LE(rows, ResidualFigure::kMostRows);
  EXPECT_GT(rows, ResidualFigure::kMostRows / 2);
}

TEST(ResidualFigures, GapsPartTheLinesAndTimeAxesGoTogether) {
  const Report report = sampleReport();
  ResidualTrace trace = residualTrace(report.channels[0], true);
  for (std::size_t i = trace.t.size() / 2; i < trace.t.size(); ++i) trace.t[i] += 3.0;
  ResidualFigure figure({"q1", {}, {trace}});
  bool parted = false;
  for (const auto& point : *figure.graph(0)->data()) parted = parted || std::isnan(point.value);
  EXPECT_TRUE(parted);
  figure.panels()[1].axes->axis(QCPAxis::atBottom)->setRange(2.0, 5.0);
  EXPECT_EQ(figure.panels()[0].axes->axis(QCPAxis::atBottom)->range(), QCPRange(2.0, 5.0));
}

TEST(ResidualFigures, WithoutACauseThereIsNoAfterAndWithoutSamplesNoPicture) {
  const Report report = sampleReport({.verdict = Verdict::kNothing});
  const ResidualFigure figure(residualData(report, report.channels[0]));
  EXPECT_EQ(rowsOf(figure, "_summary").size(), 2U);
  for (const LegendEntry& entry : figure.legend().entries()) EXPECT_FALSE(entry.text.contains("after"));
  const ResidualFigure empty(
      {"q1",
       {},
       {ResidualTrace{
           .channel = "q1", .unit = "rad", .t = {}, .measured = {}, .nominal = {}, .refitted = {}}}});
  EXPECT_TRUE(empty.panels()[0].empty->visible());
}

/// Both colours at every size, on paper and on screen.
TEST(DiagnosisFigures, ShowBeforeAndAfterOnPaperAndScreen) {
  const Report report = sampleReport({.verdict = Verdict::kSeveral, .cameras = true});
  const auto& channel = report.channels[kElbow];
  const std::pair<const char*, std::unique_ptr<Figure>> all[] = {
      {"signature",
       std::make_unique<SignatureFigure>(SignatureData{"q2", {}, {signaturePanel(channel, 0, true)}})},
      {"signatures", std::make_unique<SignatureFigure>(strongestSignatures(report, channel))},
      {"signatures_tip", std::make_unique<SignatureFigure>(strongestSignatures(report, report.channels[3]))},
      {"residual", std::make_unique<ResidualFigure>(residualData(report, channel))},
      {"residual_tip", std::make_unique<ResidualFigure>(residualData(report, report.channels[3]))}};
  QTemporaryDir folder;
  for (const auto& [name, figure] : all) {
    for (const PaperSize& size : {PaperSize{88.0, 80.0}, PaperSize{180.0, 120.0}}) {
      const QString file = QStringLiteral("%1_%2").arg(name).arg(size.width_mm);
      const auto base = std::filesystem::path(folder.path().toStdString()) / file.toStdString();
      for (const auto& written : exportFigure(*figure, base, size)) {
        if (written.extension() != ".png") continue;
        const QImage png(QString::fromStdString(written.string()));
        test::leave(png, QString::fromStdString(written.stem().string()));
        for (const Quantity quantity : {Quantity::kKinematic, Quantity::kUkf})
          EXPECT_GT(test::count(png, png.rect(), Theme::light().colour(quantity), 12).pixels, 100) << name;
      }
    }
    for (const Theme* theme : {&Theme::dark(), &Theme::light()}) {
      figure->setTheme(*theme);
      figure->canvas().resize(900, 620);
      const QImage shown = test::grab(figure->canvas(), QStringLiteral("%1_%2").arg(name, theme->name));
      EXPECT_EQ(shown.pixelColor(2, 2), theme->surface);
      for (const Quantity quantity : {Quantity::kKinematic, Quantity::kUkf})
        EXPECT_GT(test::count(shown, shown.rect(), theme->colour(quantity), 40).pixels, 30) << name;
    }
  }
}

}  // namespace
}  // namespace capstan::widgets
