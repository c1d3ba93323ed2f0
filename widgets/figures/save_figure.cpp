#include "widgets/figures/save_figure.h"

#include <QSvgGenerator>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/base/error.h"
#include "core/base/yaml.h"

namespace capstan::widgets {

namespace {

constexpr double kPixelScale = 2.0;    ///< PNG pixels per point: sharp in print
constexpr int kFigureResolution = 96;  ///< points per inch, so that text has the same size in every format

bool saveSvg(QCustomPlot& plot, const QString& file, QSize size) {
  QSvgGenerator svg;
  svg.setFileName(file);
  svg.setSize(size);
  svg.setViewBox(QRect(QPoint(0, 0), size));
  svg.setResolution(kFigureResolution);
  svg.setTitle(QStringLiteral("Capstan"));
  QCPPainter painter;
  if (!painter.begin(&svg)) return false;
  painter.setMode(QCPPainter::pmVectorized);
  painter.setMode(QCPPainter::pmNoCaching);
  plot.toPainter(&painter, size.width(), size.height());
  return painter.end();
}

/// A number as CSV text with nine digits (those of a float); empty for NaN.
std::string cell(float value) { return std::isnan(value) ? std::string(",") : fmt::format(",{:.9g}", value); }

/// `reference`: name of the columns of the reference.
std::string tableHeader(bool blocks, const char* reference) {
  std::string line = "t [s]";
  for (int joint = 0; joint < JointHistory::kJoints; ++joint)
    for (const char* what : {reference, "kinematic", "camera", "ukf", "ukf_sigma"})
      line += fmt::format(",q{}_{} [{}]", joint + 1, what,
                          tracking::kJointUnits[static_cast<std::size_t>(joint)]);
  return line + (blocks ? ",block [s],of block\n" : "\n");
}

/// Text of one row; `values` or `camera` may be missing.
std::string tableRow(double t, const JointHistory::Row* row, const JointHistory::CameraPoint* camera) {
  std::string line = fmt::format("{:.6f}", t);
  for (std::size_t joint = 0; joint < JointHistory::kJoints; ++joint) {
    const JointValues values = row ? row->joint[joint] : JointValues{NAN, NAN, NAN, NAN};
    const float seen = camera ? camera->value[joint] : NAN;
    for (const float value : {values.truth, values.kinematic, seen, values.ukf, values.ukf_sigma})
      line += cell(value);
  }
  return line;
}

constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();

/// Lines of a table in the order of time of their blocks.
class TableLines {
 public:
  void add(double t, std::string cells) { lines_.emplace(t, Line{std::move(cells), {}}); }
  void addBlock(double t, double step, std::string low, std::string high) {
    blocks_ = true;
    lines_.emplace(t, Line{std::move(low), fmt::format(",{:.6f},lowest", step)});
    lines_.emplace(t, Line{std::move(high), fmt::format(",{:.6f},highest", step)});
  }
  std::string text(const char* reference) const {
    std::string text = tableHeader(blocks_, reference);
    for (const auto& [t, line] : lines_)
      text += line.cells + (blocks_ && line.block.empty() ? ",," : line.block) + "\n";
    return text;
  }

 private:
  struct Line {
    std::string cells, block;
  };
  std::multimap<double, Line> lines_;
  bool blocks_ = false;
};

/// Rows of the motors, with the camera's measurement at the same time if there is one; blocks where no rows
/// are stored.
void addRows(const JointHistory& history, double begin, double end, TableLines& lines) {
  const double detail = history.detailBegin();
  if (begin < detail)
    history.forEach(begin, std::min(end, detail), kAll,
                    [&](double t, double step, const auto& low, const auto& high) {
                      if (t < begin || t > end || t >= detail) return;
                      const JointHistory::Row least{t, low}, most{t, high};
                      lines.addBlock(t, step, tableRow(t, &least, nullptr), tableRow(t, &most, nullptr));
                    });
  const auto& rows = history.rows();
  const auto& camera = history.camera();
  std::size_t i = rows.partitionPoint([&](const auto& row) { return row.t < std::max(begin, detail); });
  for (; i < rows.size() && rows[i].t <= end; ++i) {
    const std::size_t seen = camera.partitionPoint([&](const auto& point) { return point.t < rows[i].t; });
    const bool both = seen < camera.size() && camera[seen].t == rows[i].t;
    lines.add(rows[i].t, tableRow(rows[i].t, &rows[i], both ? &camera[seen] : nullptr));
  }
}

/// Camera measurements that are not in a row of the motors; blocks where no measurements are stored.
void addCamera(const JointHistory& history, double begin, double end, TableLines& lines) {
  const auto& camera = history.camera();
  const double detail = history.cameraDetailBegin();
  if (begin < detail)
    history.forEachCamera(
        begin, std::min(end, detail), kAll, [&](double t, double step, const auto& low, const auto& high) {
          if (t < begin || t > end || t >= detail) return;
          const JointHistory::CameraPoint least{t, low}, most{t, high};
          lines.addBlock(t, step, tableRow(t, nullptr, &least), tableRow(t, nullptr, &most));
        });
  const auto& rows = history.rows();
  std::size_t i = camera.partitionPoint([&](const auto& point) { return point.t < std::max(begin, detail); });
  for (; i < camera.size() && camera[i].t <= end; ++i) {
    const double t = camera[i].t;
    const std::size_t row = rows.partitionPoint([&](const auto& one) { return one.t < t; });
    const bool in_row = t >= history.detailBegin() && row < rows.size() && rows[row].t == t;
    if (!in_row) lines.add(t, tableRow(t, nullptr, &camera[i]));
  }
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

std::vector<std::unique_ptr<JointFigure>> jointPages(const JointHistory& history,
                                                     const std::array<QString, 3>& joint_names, double begin,
                                                     double end, QSize size) {
  const auto page = [&](std::optional<int> joint) {
    auto figure = std::make_unique<JointFigure>(history, JointFigure::Medium::kPaper);
    figure->setTheme(Theme::light());
    figure->setJointNames(joint_names);
    if (joint) figure->showOnly(*joint);
    figure->resize(size);
    figure->setTimeRange(begin, end);
    figure->refresh(true);  // lays out
    figure->refresh(true);
    return figure;
  };
  std::vector<std::unique_ptr<JointFigure>> pages;
  pages.push_back(page({}));
  if (pages.front()->fits()) return pages;
  pages.clear();
  for (int joint = 0; joint < JointHistory::kJoints; ++joint) pages.push_back(page(joint));
  return pages;
}

std::vector<std::filesystem::path> saveJointFigure(const JointHistory& history,
                                                   const std::array<QString, 3>& joint_names, double begin,
                                                   double end, const std::filesystem::path& path,
                                                   QSize size) {
  const auto pages = jointPages(history, joint_names, begin, end, size);
  std::vector<std::filesystem::path> files;
  for (std::size_t i = 0; i < pages.size(); ++i) {
    const std::string number = pages.size() > 1 ? "-page-" + std::to_string(i + 1) : std::string();
    const std::string name = path.stem().string() + number + path.extension().string();
    files.push_back(path.parent_path() / name);
    saveFigure(*pages[i], files.back(), size);
  }
  return files;
}

std::string jointTable(const JointHistory& history, double begin, double end) {
  TableLines lines;
  addRows(history, begin, end, lines);
  addCamera(history, begin, end, lines);
  return lines.text(history.ownKinematics() ? "own_kinematics" : "true");
}

void saveJointTable(const JointHistory& history, double begin, double end,
                    const std::filesystem::path& path) {
  base::writeTextFile(path, jointTable(history, begin, end));
}

std::vector<std::filesystem::path> exportJointFigure(const JointHistory& history,
                                                     const std::array<QString, 3>& joint_names, double begin,
                                                     double end, const std::filesystem::path& base,
                                                     QSize size) {
  std::vector<std::filesystem::path> files;
  for (const char* ending : {".pdf", ".svg", ".png"})
    for (auto& file : saveJointFigure(history, joint_names, begin, end, base.string() + ending, size))
      files.push_back(std::move(file));
  files.push_back(base.string() + ".csv");
  saveJointTable(history, begin, end, files.back());
  return files;
}

}  // namespace capstan::widgets
