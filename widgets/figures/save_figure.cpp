#include "widgets/figures/save_figure.h"

#include <QSvgGenerator>

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/yaml.h"

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

/// A number as CSV has it, nine digits (those of a float); empty where there is none.
std::string cell(float value) { return std::isnan(value) ? std::string(",") : fmt::format(",{:.9g}", value); }

std::string tableHeader() {
  std::string line = "t [s]";
  for (int joint = 0; joint < JointHistory::kJoints; ++joint)
    for (const char* what : {"true", "kinematic", "camera", "ukf", "ukf_sigma"})
      line += fmt::format(",q{}_{} [{}]", joint + 1, what,
                          tracking::kJointUnits[static_cast<std::size_t>(joint)]);
  return line + "\n";
}

/// The text of one row; `values` or `camera` may be missing.
std::string tableRow(double t, const JointHistory::Row* row, const JointHistory::CameraPoint* camera) {
  std::string line = fmt::format("{:.6f}", t);
  for (std::size_t joint = 0; joint < JointHistory::kJoints; ++joint) {
    const JointValues values = row ? row->joint[joint] : JointValues{NAN, NAN, NAN, NAN};
    const float seen = camera ? camera->value[joint] : NAN;
    for (const float value : {values.truth, values.kinematic, seen, values.ukf, values.ukf_sigma})
      line += cell(value);
  }
  return line + "\n";
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

void saveJointTable(const JointHistory& history, double begin, double end,
                    const std::filesystem::path& path) {
  std::string text = tableHeader();
  const auto& camera = history.camera();
  const auto& rows = history.rows();
  std::size_t next = camera.partitionPoint([&](const auto& point) { return point.t < begin; });
  std::size_t i = rows.partitionPoint([&](const auto& row) { return row.t < begin; });
  for (; i < rows.size() && rows[i].t <= end; ++i) {
    for (; next < camera.size() && camera[next].t < rows[i].t; ++next)
      text += tableRow(camera[next].t, nullptr, &camera[next]);
    const bool both = next < camera.size() && camera[next].t == rows[i].t;
    text += tableRow(rows[i].t, &rows[i], both ? &camera[next] : nullptr);
    if (both) ++next;
  }
  for (; next < camera.size() && camera[next].t <= end; ++next)
    text += tableRow(camera[next].t, nullptr, &camera[next]);
  base::writeTextFile(path, text);
}

void exportJointFigure(const JointHistory& history, const std::array<QString, 3>& joint_names, double begin,
                       double end, const std::filesystem::path& base, QSize size) {
  for (const char* ending : {".pdf", ".svg", ".png"})
    saveJointFigure(history, joint_names, begin, end, base.string() + ending, size);
  saveJointTable(history, begin, end, base.string() + ".csv");
}

}  // namespace capstan::widgets
