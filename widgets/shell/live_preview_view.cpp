#include "widgets/shell/live_preview_view.h"

#include <QGridLayout>
#include <QImage>
#include <QLabel>
#include <QPixmap>

#include "core/base/units.h"
#include "core/tracking/side_text.h"

namespace capstan::widgets {
namespace {

constexpr int kPeriod = 66;  // ms
const QSize kImage(320, 240);

void showImage(QLabel& label, const cv::Mat& bgr, const QString& none) {
  if (bgr.empty()) {
    label.setPixmap({});
    label.setText(none);
    return;
  }
  const QImage image(bgr.data, bgr.cols, bgr.rows, static_cast<int>(bgr.step), QImage::Format_BGR888);
  label.setPixmap(QPixmap::fromImage(image.scaled(kImage, Qt::KeepAspectRatio, Qt::SmoothTransformation)));
}

QString jointText(const live::LivePreviewState& state, std::size_t k) {
  if (!state.motors) return QObject::tr("joint %1: no rows yet").arg(k + 1);
  const auto i = static_cast<Eigen::Index>(k);
  return QObject::tr("joint %1: %2 %3, motor at %4° %5")
      .arg(k + 1)
      .arg(base::degreesOrMillimetres(state.joints(i), !state.prismatic[k]), 0, 'f', 2)
      .arg(state.prismatic[k] ? QStringLiteral("mm") : QStringLiteral("°"))
      .arg(base::toDegrees((*state.motors)(i)), 0, 'f', 2)
      .arg(state.moving[k] ? QObject::tr("● is moving") : QObject::tr("is at rest"));
}

}  // namespace

LivePreviewView::LivePreviewView(QWidget* parent) : QWidget(parent) {
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  for (int side = 0; side < 2; ++side) {
    auto* image = images_[static_cast<std::size_t>(side)] = new QLabel;
    image->setObjectName(side == 0 ? "preview_left" : "preview_right");
    image->setFixedSize(kImage);
    image->setAlignment(Qt::AlignCenter);
    image->setFrameShape(QFrame::StyledPanel);
    grid->addWidget(image, 0, side);
  }
  for (int joint = 0; joint < 3; ++joint) {
    auto* motor = motors_[static_cast<std::size_t>(joint)] = new QLabel;
    motor->setObjectName(QString("preview_motor_%1").arg(joint + 1));
    grid->addWidget(motor, 1 + joint, 0, 1, 2);
  }
  sides_ = new QLabel;
  sides_->setObjectName("preview_sides");
  sides_->setWordWrap(true);
  sides_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  grid->addWidget(sides_, 4, 0, 1, 2);
  grid->setRowStretch(5, 1);
  timer_.setInterval(kPeriod);
  connect(&timer_, &QTimer::timeout, this, &LivePreviewView::refresh);
  stop();
}

LivePreviewView::~LivePreviewView() = default;

void LivePreviewView::start(const live::LiveSetup& setup) {
  preview_.reset();  // it may use the same port
  cameras_ = setup.cameras.has_value();
  preview_ = std::make_unique<live::LivePreview>(setup);
  timer_.start();
  refresh();
}

void LivePreviewView::stop() {
  timer_.stop();
  preview_.reset();
  for (auto* image : images_) showImage(*image, {}, tr("no preview"));
  for (auto* motor : motors_) motor->clear();
  sides_->clear();
}

void LivePreviewView::refresh() {
  const live::LivePreviewState state = preview_->state();
  showImage(*images_[0], state.left, cameras_ ? tr("left: no images yet") : tr("no cameras in this set-up"));
  showImage(*images_[1], state.right, cameras_ ? tr("right: no images yet") : QString());
  for (std::size_t k = 0; k < 3; ++k) motors_[k]->setText(jointText(state, k));
  QStringList lines;
  for (const std::string& fault : state.faults) lines += QString::fromStdString(fault);
  for (const auto& side : state.sides) lines += QString::fromStdString(tracking::textOf(side));
  sides_->setText(lines.join('\n'));
}

}  // namespace capstan::widgets
