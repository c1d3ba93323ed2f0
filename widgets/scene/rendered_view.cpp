#include "widgets/scene/rendered_view.h"

#include <QGuiApplication>
#include <QMouseEvent>

#include "widgets/scene/render_thread.h"

namespace capstan::widgets {

namespace {

constexpr int kPeriod = 66;  ///< least time between images [ms]

}  // namespace

RenderedView::RenderedView(QWidget* parent) : QWidget(parent) {
  setAttribute(Qt::WA_OpaquePaintEvent);
  setFocusPolicy(Qt::StrongFocus);
  timer_.setInterval(kPeriod);
  connect(&timer_, &QTimer::timeout, this, [this] {
    if (changed_ && isVisible()) draw();
  });
  timer_.start();
}

bool RenderedView::available() {
  const QString platform = QGuiApplication::platformName();
  return !qEnvironmentVariableIsEmpty("DISPLAY") && (platform == "xcb" || platform.startsWith("wayland"));
}

void RenderedView::changed() {
  changed_ = true;
  if (!available()) update();
}

void RenderedView::clear() {
  image_ = {};
  drawing_ = false;
  ++cleared_;
  changed();
}

/// Asks for an image. What changes meanwhile is in the next one.
void RenderedView::draw() {
  if (drawing_) return;
  changed_ = false;
  const Drawing draw = drawing();
  if (!draw) return update();
  drawing_ = true;
  RenderThread::post([this, draw, camera = camera_, size = pixels(), cleared = cleared_] {
    const QImage image = draw(camera, size);
    const auto hand_over = [this, image, camera, cleared] {
      if (cleared == cleared_) take(image, camera);
    };
    QMetaObject::invokeMethod(this, hand_over, Qt::QueuedConnection);
  });
}

void RenderedView::take(const QImage& image, const OrbitCamera& camera) {
  drawing_ = false;
  image_ = image;
  image_.setDevicePixelRatio(devicePixelRatioF());
  image_camera_ = camera;
  update();
}

QImage RenderedView::image() {
  if (const Drawing draw = drawing()) {
    QImage image;
    RenderThread::run([&] { image = draw(camera_, pixels()); });
    clear();
    take(image, camera_);
  }
  return image_;
}

QSize RenderedView::pixels() const { return (QSizeF(size()) * devicePixelRatioF()).toSize(); }

void RenderedView::resizeEvent(QResizeEvent*) { changed(); }
void RenderedView::showEvent(QShowEvent*) { changed(); }

void RenderedView::mousePressEvent(QMouseEvent* event) {
  if (mouse_.press(*event)) setCursor(Qt::ClosedHandCursor);
}

void RenderedView::mouseMoveEvent(QMouseEvent* event) {
  if (mouse_.move(*event, camera_, height())) changed();
}

void RenderedView::mouseReleaseEvent(QMouseEvent*) {
  mouse_.release();
  unsetCursor();
}

void RenderedView::mouseDoubleClickEvent(QMouseEvent*) { resetCamera(); }

void RenderedView::wheelEvent(QWheelEvent* event) {
  OrbitMouse::wheel(*event, camera_);
  changed();
}

}  // namespace capstan::widgets
