#include "widgets/figures/save_plot.h"

#include <qcustomplot.h>

#include <QPdfWriter>
#include <QSvgGenerator>
#include <cmath>

#include "core/base/error.h"
#include "core/base/part_file.h"
#include "core/base/yaml.h"

namespace capstan::widgets {

namespace {

constexpr int kPlotResolution =
    static_cast<int>(PaperSize::kDotsPerInch);  ///< text has equal size everywhere
constexpr double kImageDotsPerInch = 300.0;

bool drawVectors(QCustomPlot& plot, QPaintDevice& device, QSize dots) {
  QCPPainter painter;
  if (!painter.begin(&device)) return false;
  painter.setMode(QCPPainter::pmVectorized);
  painter.setMode(QCPPainter::pmNoCaching);
  painter.setMode(QCPPainter::pmNonCosmetic);
  plot.toPainter(&painter, dots.width(), dots.height());
  return painter.end();
}

bool savePdf(QCustomPlot& plot, const QString& file, PaperSize size, const QString& title) {
  QPdfWriter pdf(file);
  pdf.setResolution(kPlotResolution);
  pdf.setCreator(QStringLiteral("Capstan"));
  pdf.setTitle(title);
  pdf.setPageSize(
      QPageSize(QSizeF(size.width_mm, size.height_mm), QPageSize::Millimeter, {}, QPageSize::ExactMatch));
  pdf.setPageMargins(QMarginsF(0, 0, 0, 0));
  return drawVectors(plot, pdf, size.dots());
}

bool saveSvg(QCustomPlot& plot, const QString& file, PaperSize size, const QString& title) {
  QSvgGenerator svg;
  svg.setFileName(file);
  svg.setSize(size.dots());
  svg.setViewBox(QRect(QPoint(0, 0), size.dots()));
  svg.setResolution(kPlotResolution);
  svg.setTitle(title);
  return drawVectors(plot, svg, size.dots());
}

bool savePng(QCustomPlot& plot, const QString& file, PaperSize size) {
  const QSize dots = size.dots();
  const double scale = kImageDotsPerInch / PaperSize::kDotsPerInch;
  QImage image((QSizeF(dots) * scale).toSize(), QImage::Format_RGB32);
  image.fill(Qt::white);
  QCPPainter painter;
  if (!painter.begin(&image)) return false;
  painter.scale(scale, scale);
  painter.setMode(QCPPainter::pmNoCaching);
  painter.setMode(QCPPainter::pmNonCosmetic);
  plot.toPainter(&painter, dots.width(), dots.height());
  painter.end();
  const int per_metre = static_cast<int>(std::lround(kImageDotsPerInch / 0.0254));
  image.setDotsPerMeterX(per_metre);
  image.setDotsPerMeterY(per_metre);
  return image.save(file, "png");
}

}  // namespace

void savePlot(QCustomPlot& plot, const std::filesystem::path& path, PaperSize size, const QString& title) {
  const std::string ending = path.extension().string();
  if (ending != ".png" && ending != ".pdf" && ending != ".svg")
    throw base::InputError({path.string(),
                            0,
                            {},
                            ending,
                            "is not a picture format that Capstan writes",
                            "Use .png, .pdf or .svg."});
  base::checkWritable(path);
  base::PartFile part(path, base::PartFile::Keep::kSuffix);
  const QString file = QString::fromStdString(part.path().string());
  const bool written = ending == ".png"   ? savePng(plot, file, size)
                       : ending == ".pdf" ? savePdf(plot, file, size, title)
                                          : saveSvg(plot, file, size, title);
  if (!written)
    throw base::InputError(
        {path.string(), 0, {}, {}, "cannot be written", "Check the folder and its rights."});
  part.commit();
}

std::vector<std::filesystem::path> exportFigure(const Figure& figure, const std::filesystem::path& base,
                                                const PageOptions& options,
                                                const std::vector<std::string>& endings) {
  const auto pages = pagesOf(figure, options);
  std::vector<std::filesystem::path> written;
  for (std::size_t i = 0; i < pages.size(); ++i)
    for (const std::string& ending : endings) {
      const std::string number = pages.size() > 1 ? "-page-" + std::to_string(i + 1) : std::string();
      written.emplace_back(base.string() + number + ending);
      savePlot(pages[i]->canvas(), written.back(), options.size, figure.caption());
    }
  for (const FigureNumbers& numbers : figure.numbers()) {
    written.emplace_back(base.string() + numbers.suffix + ".csv");
    base::writeTextFile(written.back(), numbers.csv);
  }
  return written;
}

}  // namespace capstan::widgets
