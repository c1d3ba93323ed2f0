#include <gtest/gtest.h>

#include <QFile>
#include <QTemporaryDir>
#include <QXmlStreamReader>

#include "core/base/error.h"
#include "tests/widgets/figures/figure_samples.h"
#include "widgets/figures/save_plot.h"

/// Vector files hold text as text, at the requested physical size.
namespace capstan::widgets {
namespace {

class FigureVectors : public testing::Test {
 protected:
  QByteArray exported(const Figure& figure, const char* ending, PaperSize size = {}) {
    const auto base = std::filesystem::path(folder_.filePath("figure").toStdString());
    exportFigure(figure, base, size);
    QFile file(QString::fromStdString(base.string() + ending));
    EXPECT_TRUE(file.open(QIODevice::ReadOnly));
    return file.readAll();
  }
  QTemporaryDir folder_;
};

struct Svg {
  QString words, width, height;
  int images = 0;
  bool sound = false;
};

Svg read(const QByteArray& content) {
  Svg svg;
  QXmlStreamReader reader(content);
  bool text = false;
  while (!reader.atEnd()) {
    reader.readNext();
    if (reader.isStartElement()) {
      if (reader.name() == QLatin1String("svg")) {
        svg.width = reader.attributes().value("width").toString();
        svg.height = reader.attributes().value("height").toString();
      }
      if (reader.name() == QLatin1String("image")) ++svg.images;
      text = reader.name() == QLatin1String("text");
    }
    if (reader.isEndElement()) text = false;
    if (text && reader.isCharacters()) svg.words += reader.text() + QLatin1Char('\n');
  }
  svg.words.replace(QChar(0x00A0), QLatin1Char(' '));
  svg.sound = !reader.hasError();
  return svg;
}

TEST_F(FigureVectors, SvgHasWordsAsText) {
  const HistogramFigure histogram(histogramSample());
  const Svg svg = read(exported(histogram, ".svg"));
  ASSERT_TRUE(svg.sound);
  EXPECT_EQ(svg.images, 0);
  for (const char* word : {"Experiment C, trial 1: errors of the joint positions", "elbow q2 [deg]",
                           "error [mm]", "kinematic", "n 18800", "mean"})
    EXPECT_TRUE(svg.words.contains(word)) << word << " in\n" << svg.words.toStdString();

  const Svg boxes = read(exported(BoxplotFigure(boxplotSample()), ".svg"));
  for (const char* word : {"1.00", "1.50", "trial [–], n below", "18800", "of 12346 outliers drawn"})
    EXPECT_TRUE(boxes.words.contains(word)) << word << " in\n" << boxes.words.toStdString();

  const Svg radius = read(exported(ConvergenceFigure(radiusSample()), ".svg"));
  for (const char* word : {"truth 59.00", "settled after 41 s", "nominal", "time [s]"})
    EXPECT_TRUE(radius.words.contains(word)) << word << " in\n" << radius.words.toStdString();
}

TEST_F(FigureVectors, SvgHasTheSizeAskedFor) {
  const Svg svg = read(exported(ConvergenceFigure(radiusSample()), ".svg", {88.0, 60.0}));
  EXPECT_NEAR(svg.width.left(svg.width.size() - 2).toDouble(), 88.0, 0.3) << svg.width.toStdString();
  EXPECT_NEAR(svg.height.left(svg.height.size() - 2).toDouble(), 60.0, 0.3);
}

TEST_F(FigureVectors, PdfHasFontsAndNoPixelsAtTheSizeAskedFor) {
  const QByteArray pdf = exported(BoxplotFigure(boxplotSample()), ".pdf", {88.0, 60.0});
  EXPECT_TRUE(pdf.startsWith("%PDF-1."));
  EXPECT_TRUE(pdf.trimmed().endsWith("%%EOF"));
  EXPECT_TRUE(pdf.contains("/FontFile2")) << "fonts are embedded";
  EXPECT_TRUE(pdf.contains("/ToUnicode")) << "and their glyphs are letters";
  EXPECT_FALSE(pdf.contains("/Subtype /Image"));
  const int box = pdf.indexOf("/MediaBox [");
  ASSERT_GE(box, 0);
  const QList<QByteArray> sides = pdf.mid(box + 11, pdf.indexOf(']', box) - box - 11).simplified().split(' ');
  ASSERT_EQ(sides.size(), 4);
  EXPECT_NEAR(sides[2].toDouble(), 88.0 / 25.4 * 72.0, 1.0);
  EXPECT_NEAR(sides[3].toDouble(), 60.0 / 25.4 * 72.0, 1.0);
}

TEST_F(FigureVectors, NamesTheFileThatCannotBeWritten) {
  const ConvergenceFigure figure(radiusSample());
  const auto base = std::filesystem::path(folder_.filePath("no such folder/figure").toStdString());
  for (const char* ending : {".pdf", ".svg", ".png"}) try {
      exportFigure(figure, base, {}, {ending});
      ADD_FAILURE() << ending;
    } catch (const base::InputError& error) {
      EXPECT_NE(std::string(error.what()).find("no such folder"), std::string::npos) << error.what();
    }
  EXPECT_THROW(exportFigure(figure, folder_.filePath("a").toStdString(), {}, {".bmp"}), base::InputError);
}

}  // namespace
}  // namespace capstan::widgets
