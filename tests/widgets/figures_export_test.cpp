#include <gtest/gtest.h>

#include <QDir>
#include <QFile>
#include <QTemporaryDir>
#include <QXmlStreamReader>
#include <cmath>

#include "core/base/error.h"
#include "tests/widgets/picture.h"
#include "tests/widgets/synthetic_motion.h"
#include "widgets/figures/paper_size.h"
#include "widgets/figures/save_figure.h"

namespace capstan::widgets {
namespace {

class ExportTest : public testing::Test {
 protected:
  void SetUp() override {
    for (int ms = 0; ms < 12'000; ms += 5) {
      tracking::Snapshot snapshot = syntheticSnapshot(ms * 1e-3);
      snapshot.camera_updated = ms % 65 == 0;
      snapshot.t_cam = snapshot.t - 0.0013;  // an exposure between two rows
      if (ms % 1000 == 0) snapshot.q_link_true.setConstant(std::nan(""));
      history_.append(snapshot);
    }
    base_ = folder_.filePath("run 1.5").toStdString();
  }
  QByteArray content(const char* ending) const {
    QFile file(QString::fromStdString(base_ + ending));
    EXPECT_TRUE(file.open(QIODevice::ReadOnly)) << ending;
    return file.readAll();
  }
  void exportAll() { exportJointFigure(history_, names_, 2.0, 11.0, base_, {900, 700}); }

  JointHistory history_{4096};
  std::array<QString, 3> names_ = {"shoulder", "elbow", "insertion"};
  QTemporaryDir folder_;
  std::string base_;
};

TEST_F(ExportTest, WritesPdfWithTextAsText) {
  exportAll();
  const QByteArray pdf = content(".pdf");
  EXPECT_TRUE(pdf.startsWith("%PDF-1."));
  EXPECT_TRUE(pdf.trimmed().endsWith("%%EOF"));
  EXPECT_TRUE(pdf.contains("/FontFile2")) << "fonts are embedded";
  EXPECT_FALSE(pdf.contains("/Subtype /Image")) << "vectors, no pixels";
}

TEST_F(ExportTest, WritesWellFormedSvgWithItsWordsAndColours) {
  exportAll();
  QXmlStreamReader svg(content(".svg"));
  QString words, view_box;
  int lines = 0, images = 0;
  QStringList strokes;
  while (!svg.atEnd()) {
    svg.readNext();
    if (svg.isStartElement()) {
      if (svg.name() == QLatin1String("svg")) view_box = svg.attributes().value("viewBox").toString();
      if (svg.name() == QLatin1String("polyline") || svg.name() == QLatin1String("path")) ++lines;
      if (svg.name() == QLatin1String("image")) ++images;
      strokes << svg.attributes().value("stroke").toString().toLower();
    }
    if (svg.isCharacters()) words += svg.text();
  }
  EXPECT_FALSE(svg.hasError()) << svg.errorString().toStdString();
  EXPECT_EQ(view_box, "0 0 900 700");
  for (const char* word : {"shoulder q1 [deg]", "insertion q3 [mm]", "kinematic", "time [s]", "occluded",
                           "1801 points drawn", "2.00 to 11.00 s"})
    EXPECT_TRUE(words.contains(word)) << word;
  EXPECT_GT(lines, 20);
  EXPECT_EQ(images, 0);
  for (const char* colour : {"#d55e00", "#009e73", "#000000"})
    EXPECT_TRUE(strokes.contains(colour)) << colour;
}

TEST_F(ExportTest, WritesALightPngOfTwoPixelsAPoint) {
  exportAll();
  const QImage png(QString::fromStdString(base_ + ".png"));
  ASSERT_EQ(png.size(), QSize(1800, 1400));
  test::leave(png, "figure_export");
  EXPECT_EQ(png.pixelColor(3, 3), QColor(Qt::white));
  for (const Quantity quantity : {Quantity::kKinematic, Quantity::kCamera, Quantity::kUkf})
    EXPECT_GT(test::count(png, png.rect(), Theme::light().colour(quantity), 16).pixels, 500);
}

TEST_F(ExportTest, TableEqualsTheHistoryToTheFloat) {
  exportAll();
  const QList<QByteArray> lines = content(".csv").trimmed().split('\n');
  const QList<QByteArray> names = lines[0].split(',');
  ASSERT_EQ(names.size(), 16);
  EXPECT_EQ(names[0], "t [s]");
  EXPECT_EQ(names[3], "q1_camera [deg]");
  EXPECT_EQ(names[15], "q3_ukf_sigma [mm]");
  int rows = 0, seen = 0, gaps = 0;
  double last = 0.0;
  for (int i = 1; i < lines.size(); ++i) {
    const QList<QByteArray> cells = lines[i].split(',');
    ASSERT_EQ(cells.size(), 16) << i;
    const double t = cells[0].toDouble();
    EXPECT_GT(t, last);
    last = t;
    for (int joint = 0; joint < 3; ++joint) {
      const auto j = static_cast<std::size_t>(joint);
      const int first = 1 + 5 * joint;
      if (!cells[first + 2].isEmpty()) {
        EXPECT_EQ(cells[first + 2].toFloat(), history_.cameraAt(t, 1e-5)->value[j]);
        ++seen;
      }
      if (cells[first + 3].isEmpty()) continue;
      const JointValues wanted = history_.at(t)->joint[j];
      EXPECT_EQ(cells[first + 1].toFloat(), wanted.kinematic);
      EXPECT_EQ(cells[first + 3].toFloat(), wanted.ukf);
      EXPECT_EQ(cells[first + 4].toFloat(), wanted.ukf_sigma);
      if (cells[first].isEmpty())
        ++gaps;
      else
        EXPECT_EQ(cells[first].toFloat(), wanted.truth);
      ++rows;
    }
  }
  EXPECT_EQ(rows, 3 * 1801);
  EXPECT_EQ(gaps, 3 * 10) << "the truth is not known at whole seconds: an empty cell";
  const auto& camera = history_.camera();
  int wanted = 0;
  for (std::size_t i = 0; i < camera.size(); ++i) wanted += camera[i].t >= 2.0 && camera[i].t <= 11.0 ? 1 : 0;
  EXPECT_GT(wanted, 50);
  EXPECT_EQ(seen, 3 * wanted) << "each observation once, in a row of its own time";
}

std::vector<QRectF> numbersOf(const QCPAxis& axis) {
  std::vector<QRectF> boxes;
  const QFontMetricsF metrics(axis.tickLabelFont());
  for (int i = 0; axis.tickLabels() && i < axis.tickVector().size(); ++i) {
    if (!axis.range().contains(axis.tickVector()[i])) continue;
    const QSizeF size = metrics.size(0, axis.tickVectorLabels()[i]);
    const double at = axis.coordToPixel(axis.tickVector()[i]);
    const QPointF corner =
        axis.orientation() == Qt::Horizontal
            ? QPointF(at - 0.5 * size.width(), axis.axisRect()->bottom() + 6.0)
            : QPointF(axis.axisRect()->left() - 6.0 - size.width(), at - 0.5 * size.height());
    boxes.emplace_back(corner, size);
  }
  return boxes;
}

TEST_F(ExportTest, PagesOfEverySizeHaveRoomForPlotsWordsAndNumbers) {
  for (const PaperSize size : {PaperSize{88.0, 60.0}, {88.0, 90.0}, {180.0, 120.0}, {180.0, 240.0}}) {
    const auto pages = jointPages(history_, names_, 2.0, 11.0, size.dots());
    EXPECT_EQ(pages.size(), size.height_mm < 90.0 ? 3U : 1U) << size.width_mm << " x " << size.height_mm;
    for (std::size_t page = 0; page < pages.size(); ++page) {
      JointFigure& figure = *pages[page];
      std::vector<QRectF> boxes;
      const auto take = [&](const FigureHeader& header) {
        for (const FigureHeader::Text& text : header.texts()) boxes.push_back(text.box);
      };
      take(figure.legend());
      for (int joint = 0; joint < 3; ++joint) {
        const JointPlot& plot = figure.plot(joint);
        if (!plot.axes()->realVisibility()) continue;
        EXPECT_GE(plot.axes()->height(), 10.0 / 25.4 * 96.0);
        EXPECT_EQ(plot.axes()->axis(QCPAxis::atLeft)->label(),
                  joint < 2 ? QString("q%1 [deg]").arg(joint + 1) : "q3 [mm]");
        EXPECT_GT(plot.shade().drawn(), 0);
        take(*plot.header());
        boxes.emplace_back(plot.axes()->rect().adjusted(0, 0, -1, -1));
        for (const auto type : {QCPAxis::atLeft, QCPAxis::atBottom})
          for (const QRectF& box : numbersOf(*plot.axes()->axis(type))) boxes.push_back(box);
      }
      for (std::size_t i = 0; i < boxes.size(); ++i) {
        EXPECT_TRUE(QRectF(QPointF(), size.dots()).adjusted(-1, -1, 1, 1).contains(boxes[i])) << i;
        for (std::size_t j = 0; j < i; ++j)
          EXPECT_FALSE(boxes[i].adjusted(1, 1, -1, -1).intersects(boxes[j].adjusted(1, 1, -1, -1)))
              << size.width_mm << " x " << size.height_mm << ", page " << page + 1 << ": " << i << " and "
              << j;
      }
      test::leave(figure.toPixmap(0, 0, 2.0).toImage(),
                  QStringLiteral("joints_%1x%2_%3").arg(size.width_mm).arg(size.height_mm).arg(page + 1));
    }
  }
}

TEST_F(ExportTest, NamesTheFileThatCannotBeWritten) {
  base_ = folder_.filePath("no such folder/run").toStdString();
  for (const char* ending : {".pdf", ".svg", ".png"}) try {
      saveJointFigure(history_, names_, 2.0, 11.0, base_ + ending, {400, 300});
      ADD_FAILURE() << ending;
    } catch (const base::InputError& error) {
      EXPECT_EQ(error.fault().file, base_ + ending);
    }
  try {
    saveJointTable(history_, 2.0, 11.0, base_ + ".csv");
    ADD_FAILURE();
  } catch (const base::InputError& error) {
    EXPECT_NE(std::string(error.what()).find(base_), std::string::npos);
  }
  EXPECT_THROW(saveJointFigure(history_, names_, 2.0, 11.0, folder_.filePath("a.bmp").toStdString()),
               base::InputError);
}

}  // namespace
}  // namespace capstan::widgets
