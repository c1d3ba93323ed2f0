#include "widgets/scene/cloud_view.h"

#include <QKeyEvent>
#include <QLocale>
#include <QPainter>
#include <algorithm>
#include <utility>

#include "widgets/scene/render_thread.h"
#include "widgets/scene/scene_labels.h"

namespace capstan::widgets {

namespace {

constexpr double kAzimuth = 0.2, kElevation = 0.42;  ///< angles of the initial view [rad]
constexpr double kKeyPoints = 9.5;

Eigen::AlignedBox3d boxOf(const std::vector<PointCloud>& clouds) {
  Eigen::AlignedBox3d box;
  for (const bool framed : {true, false}) {
    if (!framed && !box.isEmpty()) break;
    for (const PointCloud& cloud : clouds)
      for (const Eigen::Vector3d& point : cloud.points)
        if (cloud.framed == framed) box.extend(point);
  }
  return box;
}

/// Distance of grid lines, 10, 20 or 50 mm …: about ten lines along the longest side.
double cellFor(const Eigen::AlignedBox3d& box) {
  const double longest = box.sizes().maxCoeff();
  for (const double cell : {0.005, 0.01, 0.02, 0.05, 0.1, 0.2})
    if (longest <= 12.0 * cell) return cell;
  return 0.5;
}

}  // namespace

CloudView::CloudView(QWidget* parent) : RenderedView(parent) {
  setAccessibleName(tr("positions in 3-D"));
  setToolTip(tr("Drag: orbit · shift drag: pan · wheel, + −: zoom · double click, Home: back"));
}

CloudView::~CloudView() {
  RenderThread::run([this] { renderer_.reset(); });
}

void CloudView::setTheme(const Theme& theme) {
  theme_ = theme;
  clouds_changed_ = true;
  changed();
}

void CloudView::setEmptyWords(const QString& words) {
  empty_words_ = words;
  update();
}

bool CloudView::empty() const {
  return std::all_of(clouds_.begin(), clouds_.end(),
                     [](const PointCloud& cloud) { return cloud.points.empty(); });
}

void CloudView::setClouds(std::vector<PointCloud> clouds) {
  const bool first = empty();
  clouds_ = std::move(clouds);
  clouds_changed_ = true;
  if (!empty()) {
    const Eigen::AlignedBox3d box = boxOf(clouds_);
    grid_ = gridAround({box.min(), box.max()}, 2, 1.0, cellFor(box));
    if (first) resetCamera();
  }
  changed();
}

void CloudView::resetCamera() {
  if (empty()) return;
  const Eigen::Vector3d middle = 0.5 * (grid_.low + grid_.high);
  camera_.setAxes(Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX());  // towards the numbered edges
  camera_.look(middle, 1.95 * (grid_.high - grid_.low).norm(), kAzimuth, kElevation);
  changed();
}

CloudView::Drawing CloudView::drawing() {
  if (empty() || !available()) return {};
  if (std::exchange(clouds_changed_, false))
    RenderThread::post([this, theme = theme_, grid = grid_, clouds = clouds_] {
      if (!renderer_) renderer_ = std::make_unique<CloudRenderer>();
      renderer_->setColours(theme.surface, theme.isDark() ? theme.border : theme.border.darker(105));
      renderer_->setGrid(grid);
      renderer_->setClouds(clouds);
    });
  return [this](const OrbitCamera& camera, const QSize& size) { return renderer_->render(camera, size); };
}

void CloudView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  if (empty() || !available() || image_.isNull()) {
    painter.fillRect(rect(), theme_.surface);
    painter.setPen(theme_.muted);
    painter.setFont(textFont(10.5));
    const QString words = !available() ? tr("3-D view needs a display") : empty() ? empty_words_ : QString();
    painter.drawText(rect().adjusted(20, 20, -20, -20), Qt::AlignCenter | Qt::TextWordWrap, words);
    return;
  }
  painter.drawImage(rect(), image_);
  painter.setRenderHint(QPainter::Antialiasing);
  drawGridLabels(painter, grid_, image_camera_, size(), theme_);
  drawKey(painter);
}

/// Draws the key in the upper right corner; the upright scale is left of it.
void CloudView::drawKey(QPainter& painter) const {
  constexpr int kMark = 18, kEdge = 10;
  painter.setFont(textFont(kKeyPoints));
  const QFontMetrics metrics = painter.fontMetrics();
  QList<std::pair<QColor, QString>> entries;
  int widest = 0;
  for (const PointCloud& cloud : clouds_) {
    if (!cloud.shown || cloud.points.empty()) continue;
    const QString count = QLocale(QLocale::English).toString(qulonglong(cloud.points.size()));
    entries.append({cloud.colour, tr("%1 (%2)").arg(cloud.name, count)});
    widest = std::max(widest, metrics.horizontalAdvance(entries.back().second));
  }
  const int line = metrics.height() + 2, x = width() - kEdge - widest;
  int y = 8;
  for (const auto& [colour, words] : entries) {
    painter.setPen(Qt::NoPen);
    painter.setBrush(colour);
    painter.drawEllipse(QPointF(x - kMark + 5.0, y + 0.5 * line), 4.0, 4.0);
    painter.setPen(theme_.text);
    painter.drawText(QRect(x, y, widest + kEdge, line), Qt::AlignLeft | Qt::AlignVCenter, words);
    y += line;
  }
}

void CloudView::keyPressEvent(QKeyEvent* event) {
  switch (event->key()) {
    case Qt::Key_Home:
      return resetCamera();
    case Qt::Key_Plus:
    case Qt::Key_Minus:
      camera_.zoom(event->key() == Qt::Key_Plus ? 0.9 : 1.0 / 0.9);
      return changed();
    default:
      QWidget::keyPressEvent(event);
  }
}

}  // namespace capstan::widgets
