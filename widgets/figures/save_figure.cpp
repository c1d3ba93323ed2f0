#include "widgets/figures/save_figure.h"

#include <QSvgGenerator>

#include "core/base/error.h"

namespace capstan::widgets {

namespace {

constexpr double kPixelScale = 2.0;  ///< PNG pixels a point: sharp in print
constexpr int kResolution = 96;      ///< points an inch, so that text keeps its size in every format

bool saveSvg(QCustomPlot& plot, const QString& file, QSize size) {
  QSvgGenerator svg;
  svg.setFileName(file);
  svg.setSize(size);
  svg.setViewBox(QRect(QPoint(0, 0), size));
  svg.setResolution(kResolution);
  svg.setTitle(QStringLiteral("Capstan"));
  QCPPainter painter;
  if (!painter.begin(&svg)) return false;
  painter.setMode(QCPPainter::pmVectorized);
  painter.setMode(QCPPainter::pmNoCaching);
  plot.toPainter(&painter, size.width(), size.height());
  return painter.end();
}

}  // namespace

void saveFigure(JointFigure& figure, const std::filesystem::path& path, QSize size) {
  const std::string ending = path.extension().string();
  const QString file = QString::fromStdString(path.string());
  bool written = false;
  if (ending == ".png") {
    written = figure.savePng(file, size.width(), size.height(), kPixelScale);
  } else if (ending == ".pdf") {
    written = figure.savePdf(file, size.width(), size.height(), QCP::epAllowCosmetic,
                             QStringLiteral("Capstan"), QString::fromStdString(path.stem().string()));
  } else if (ending == ".svg") {
    written = saveSvg(figure, file, size);
  } else {
    throw base::InputError({path.string(),
                            0,
                            {},
                            ending,
                            "is not a picture format that Capstan writes",
                            "Use .png, .pdf or .svg."});
  }
  if (!written)
    throw base::InputError(
        {path.string(), 0, {}, {}, "cannot be written", "Check the folder and its rights."});
}

void saveJointFigure(const JointHistory& history, const std::array<QString, 3>& joint_names, double begin,
                     double end, const std::filesystem::path& path, QSize size) {
  JointFigure figure(history, JointFigure::Medium::kPaper);
  figure.setTheme(Theme::light());
  figure.setJointNames(joint_names);
  figure.resize(size);
  figure.setTimeRange(begin, end);
  figure.refresh(true);  // lays out
  figure.refresh(true);
  saveFigure(figure, path, size);
}

}  // namespace capstan::widgets
