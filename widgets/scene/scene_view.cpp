#include "widgets/scene/scene_view.h"

#include <QContextMenuEvent>
#include <QMenu>
#include <QPainter>
#include <QShortcut>
#include <cmath>
#include <utility>

#include "widgets/scene/render_thread.h"
#include "widgets/scene/scene_renderer.h"

namespace capstan::widgets {

namespace {

constexpr double kEllipsoidSigmas = 2.0;
constexpr double kEllipsoidWanted = 0.012;  // [m] half axis that can be seen from the opening view

Eigen::Vector3d workspaceCentre(const WorkspaceGrid& grid) { return 0.5 * (grid.low + grid.high); }

}  // namespace

SceneView::SceneView(QWidget* parent) : RenderedView(parent) {
  setAccessibleName("3-D view");
  setToolTip(
      "Drag or arrow keys: orbit · shift drag: pan · wheel, + and −: zoom · double click or Home: back · "
      "menu key: more");
  const auto key = [this](Qt::Key code, auto act) {
    auto* shortcut = new QShortcut(code, this);
    shortcut->setContext(Qt::WidgetShortcut);
    connect(shortcut, &QShortcut::activated, this, [this, act] {
      act();
      changed();
    });
  };
  constexpr double kTurn = 0.1, kNearer = 0.9;  // [rad] and share of the distance, a press
  key(Qt::Key_Left, [this] { camera_.orbit(kTurn, 0.0); });
  key(Qt::Key_Right, [this] { camera_.orbit(-kTurn, 0.0); });
  key(Qt::Key_Up, [this] { camera_.orbit(0.0, kTurn); });
  key(Qt::Key_Down, [this] { camera_.orbit(0.0, -kTurn); });
  key(Qt::Key_Plus, [this] { camera_.zoom(kNearer); });
  key(Qt::Key_Minus, [this] { camera_.zoom(1.0 / kNearer); });
  key(Qt::Key_Home, [this] { resetCamera(); });
}

SceneView::~SceneView() {
  RenderThread::run([this] { renderer_.reset(); });
}

/// The renderer stays for another robot: OpenGL contexts are dear.
void SceneView::configure() {
  configured_ = true;
  RenderThread::post([this, theme = theme_, arm = shapeOf(*robot_), grid = grid_, rig = rig_,
                      base_from_camera = base_from_camera_] {
    if (!renderer_) renderer_ = std::make_unique<SceneRenderer>();
    renderer_->setTheme(theme);
    renderer_->setArm(arm);
    renderer_->setGrid(grid);
    renderer_->setRig(rig, base_from_camera);
  });
}

void SceneView::setTheme(const Theme& theme) {
  theme_ = theme;
  if (configured_) RenderThread::post([this, theme] { renderer_->setTheme(theme); });
  changed();
}

void SceneView::setRobot(const robot::Description& robot, const std::optional<vision::StereoRig>& rig,
                         const std::optional<Eigen::Isometry3d>& base_from_camera) {
  robot_ = robot;
  arm_.emplace(robot);
  rig_ = rig;
  const auto [axis, sign] = upAxis(robot.gravity);
  grid_ = gridAround(reachOf(robot), axis, sign);
  trail_.clear();
  snapshot_.reset();
  tension_.reset();
  configured_ = false;
  clear();
  setRegistration(base_from_camera);
  resetCamera();
}

void SceneView::setRegistration(const std::optional<Eigen::Isometry3d>& base_from_camera) {
  base_from_camera_ = base_from_camera;
  captions_.cameras = {};
  if (rig_ && base_from_camera_)
    captions_.cameras = {base_from_camera_->translation(),
                         (*base_from_camera_ * rig_->right_from_left.inverse()).translation()};
  if (configured_)
    RenderThread::post([this, rig = rig_, base_from_camera] { renderer_->setRig(rig, base_from_camera); });
  changed();
}

void SceneView::resetCamera() {
  if (!robot_) return;
  const auto [axis, sign] = upAxis(robot_->gravity);
  const Eigen::Vector3d up = sign * Eigen::Vector3d::Unit(axis);
  const Eigen::Vector3d tip = workspaceCentre(grid_);
  const Eigen::Vector3d towards =
      base_from_camera_ ? base_from_camera_->translation() - tip : Eigen::Vector3d(tip);
  const Eigen::Vector3d level = towards - towards.dot(up) * up;
  camera_.setAxes(up, level.norm() > 1e-3 ? level : up.unitOrthogonal());
  camera_.look(0.5 * tip + 0.12 * up, 2.0, 0.75, 0.35);
  changed();
}

void SceneView::showSnapshot(const tracking::Snapshot& snapshot) {
  keepTrail(snapshot);
  snapshot_ = snapshot;
  changed();
}

void SceneView::keepTrail(const tracking::Snapshot& snapshot) {
  if (!trail_.empty() && snapshot.t < trail_.back().t) trail_.clear();
  if (!snapshot.tip_ukf.allFinite()) return;
  if (trail_.empty() || snapshot.t - trail_.back().t >= 0.02)
    trail_.push_back({snapshot.t, snapshot.tip_ukf});
  while (!trail_.empty() && trail_.front().t < snapshot.t - trail_seconds_) trail_.pop_front();
}

void SceneView::setEllipsoidScale(double factor) {
  asked_scale_ = factor;
  changed();
}

void SceneView::chooseEllipsoidScale() {
  const double largest = kEllipsoidSigmas * std::sqrt(snapshot_->tip_ukf_covariance.diagonal().maxCoeff());
  if (asked_scale_ > 0.0) {
    captions_.ellipsoid_scale = asked_scale_;
  } else if (std::isfinite(largest) && largest > 0.0) {
    const double drawn = largest * captions_.ellipsoid_scale;
    if (drawn > 0.4 * kEllipsoidWanted && drawn < 2.5 * kEllipsoidWanted) return;
    captions_.ellipsoid_scale = 1.0;
    for (const double factor : {2.0, 5.0, 10.0, 20.0, 50.0, 100.0})
      if (largest * factor <= 1.2 * kEllipsoidWanted) captions_.ellipsoid_scale = factor;
  }
}

ScenePose SceneView::pose() {
  ScenePose pose;
  const bool known = snapshot_ && (snapshot_->q_link_ukf.allFinite() || snapshot_->q_link_kin.allFinite());
  Eigen::Vector3d q;
  for (int i = 0; i < 3; ++i) q(i) = robot_->joints[static_cast<std::size_t>(i)].homing;
  captions_.tension.setConstant(std::nan(""));
  if (known) {
    q = snapshot_->q_link_ukf.allFinite() ? snapshot_->q_link_ukf : snapshot_->q_link_kin;
    captions_.tension = snapshot_->cable_tension;
    tension_.include(captions_.tension);
    chooseEllipsoidScale();
    const double scale = kEllipsoidSigmas * captions_.ellipsoid_scale;
    pose.ellipsoid = scale * scale * snapshot_->tip_ukf_covariance;
    captions_.tip_sigma = snapshot_->tip_ukf_covariance.diagonal().cwiseSqrt();
    for (std::size_t side = 0; side < 2; ++side) captions_.marker[side] = visibilityOf(*snapshot_, side);
  }
  for (int i = 0; i < 4; ++i) pose.frames[static_cast<std::size_t>(i)] = arm_->frame(i, q);
  for (int i = 0; i < 3; ++i)
    pose.cables[static_cast<std::size_t>(i)] = tension_.colour(captions_.tension(i));
  pose.tip = arm_->tip(q);
  pose.marker = captions_.marker;
  for (const auto& point : trail_) pose.trail.push_back(point.tip);
  return pose;
}

SceneView::Drawing SceneView::drawing() {
  if (!robot_ || !available()) return {};
  if (!configured_) configure();
  return [this, pose = pose()](const OrbitCamera& camera, const QSize& size) {
    renderer_->pose(pose);
    return renderer_->render(camera, size);
  };
}

void SceneView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  if (!available() || !robot_) {
    painter.fillRect(rect(), theme_.surface);
    painter.setPen(theme_.muted);
    painter.setFont(textFont(10.0));
    painter.drawText(rect(), Qt::AlignCenter | Qt::TextWordWrap,
                     available() ? "No robot yet" : "3-D view needs a display");
    return;
  }
  if (image_.isNull()) {
    painter.fillRect(rect(), theme_.surface);
    return;
  }
  painter.drawImage(rect(), image_);
  painter.setRenderHint(QPainter::Antialiasing);
  drawGridLabels(painter, grid_, image_camera_, size(), theme_);
  drawCameraLabels(painter, captions_, image_camera_, size(), theme_);
  if (height() < 170 || width() < 380) return;
  drawTensionLegend(painter, captions_, tension_, size(), theme_);
  drawSceneKey(painter, captions_, trail_seconds_, theme_);
}

void SceneView::contextMenuEvent(QContextMenuEvent* event) {
  QMenu menu(this);
  const auto look = [this](double azimuth, double elevation) {
    camera_.look(camera_.focus(), camera_.distance(), azimuth, elevation);
    changed();
  };
  menu.addAction("Opening view", this, &SceneView::resetCamera);
  menu.addAction("From the cameras", this, [look] { look(0.0, 0.0); });
  menu.addAction("From the side", this, [look] { look(M_PI / 2, 0.0); });
  menu.addAction("From above", this, [look] { look(0.0, M_PI / 2); });
  menu.addAction("Close to the tip", this, [this] {
    if (snapshot_ && snapshot_->tip_ukf.allFinite()) camera_.setFocus(snapshot_->tip_ukf);
    camera_.look(camera_.focus(), 0.35, camera_.azimuth(), camera_.elevation());
    changed();
  });
  menu.addSeparator();
  QMenu* scale = menu.addMenu("Ellipsoid");
  for (const double factor : {0.0, 1.0, 10.0, 50.0}) {
    auto* action = scale->addAction(factor > 0.0 ? QString("×%1").arg(factor) : QString("automatic"), this,
                                    [this, factor] { setEllipsoidScale(factor); });
    action->setCheckable(true);
    action->setChecked(factor == asked_scale_);
  }
  menu.exec(event->globalPos());
}

}  // namespace capstan::widgets
