#include "widgets/panels/registration/camera_strip.h"

#include <QBoxLayout>
#include <QGridLayout>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QVariant>
#include <algorithm>

namespace capstan::widgets {

using registration::CameraCheck;
using registration::CheckState;

namespace {

constexpr int kSeePeriod = 100, kRefreshPeriod = 250;  ///< [ms]
constexpr int kStripColumns = 2;

QString shown(const std::string& text) { return QString::fromStdString(text); }

QString lineOf(const CameraCheck& check) {
  const QString mark = check.state == CheckState::kPass   ? QStringLiteral("✓")
                       : check.state == CheckState::kFail ? QStringLiteral("✗")
                                                          : QStringLiteral("·");
  return QString("%1 %2: %3").arg(mark, shown(check.name), shown(check.value));
}

}  // namespace

BrightnessView::BrightnessView(const QString& name, QWidget* parent) : QWidget(parent), name_(name) {
  setAccessibleName(tr("histogram of the %1 image").arg(name));
  setToolTip(tr("Brightness of the %1 image: levels 0 to 255 to the right, share of the pixels upwards "
                "(square root). Clipped levels are marked.")
                 .arg(name));
}

void BrightnessView::setTheme(const Theme& theme) {
  theme_ = theme;
  update();
}

void BrightnessView::showExposure(const vision::Exposure& exposure) {
  exposure_ = exposure;
  update();
}

void BrightnessView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), theme_.surface);
  const double most = *std::ranges::max_element(exposure_.histogram);
  const double wide = static_cast<double>(width()) / vision::kHistogramBins;
  for (std::size_t bin = 0; most > 0.0 && bin < vision::kHistogramBins; ++bin) {
    const double tall = std::sqrt(exposure_.histogram[bin] / most) * (height() - 2);
    const bool clipped = (bin + 1) * 256 / vision::kHistogramBins > vision::kClipped;
    painter.fillRect(QRectF(static_cast<double>(bin) * wide, height() - tall, wide, tall),
                     clipped ? theme_.fault : theme_.colour(Quantity::kCamera));
  }
  painter.setPen(theme_.border);
  painter.drawRect(rect().adjusted(0, 0, -1, -1));
  painter.setPen(theme_.text);
  painter.setFont(textFont(8.5));
  painter.drawText(rect().adjusted(4, 1, -4, 0), Qt::AlignTop | Qt::AlignLeft, name_);
}

CameraStrip::CameraStrip(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(6);
  auto* top = new QHBoxLayout;
  top->setSpacing(8);
  auto* grid = new QGridLayout;
  grid->setHorizontalSpacing(14);
  grid->setVerticalSpacing(2);
  for (std::size_t i = 0; i < kChecks; ++i) {
    labels_[i] = new QLabel;
    labels_[i]->setFont(textFont(9.5));
    grid->addWidget(labels_[i], static_cast<int>(i) / kStripColumns, static_cast<int>(i) % kStripColumns);
  }
  grid->setColumnStretch(kStripColumns - 1, 1);
  top->addLayout(grid, 1);
  for (std::size_t side = 0; side < 2; ++side)
    top->addWidget(brightness_[side] = new BrightnessView(side == 0 ? tr("left") : tr("right")));
  column->addLayout(top);
  notice_ = new QWidget;
  notice_->setAttribute(Qt::WA_StyledBackground);
  auto* row = new QHBoxLayout(notice_);
  row->setContentsMargins(8, 6, 8, 6);
  remedies_ = new QLabel;
  remedies_->setWordWrap(true);
  remedies_->setAccessibleName(tr("what to do about the cameras"));
  button_ = new QPushButton;
  button_->setObjectName("cameraRemedy");
  button_->setProperty("primary", true);
  row->addWidget(remedies_, 1);
  row->addWidget(button_);
  column->addWidget(notice_);
  connect(button_, &QPushButton::clicked, this, [this] {
    if (const auto remedy = checks_ ? checks_->remedy() : std::nullopt) Q_EMIT remedyRequested(*remedy);
  });
  setTheme(theme_);
  begin({}, {});
}

void CameraStrip::setTheme(const Theme& theme) {
  theme_ = theme;
  for (auto* view : brightness_) view->setTheme(theme);
  notice_->setStyleSheet(QString(".QWidget { %1 }").arg(noticeStyle(theme, theme.warning)));
  refresh();
}

void CameraStrip::begin(const std::optional<vision::StereoRig>& rig, const vision::MarkerOptions& marker) {
  checks_ = rig ? std::make_unique<registration::CameraChecks>(rig, marker) : nullptr;
  for (auto* view : brightness_) view->showExposure({});
  setVisible(checks_ != nullptr);
  seen_.invalidate();
  refresh();
}

void CameraStrip::setMarker(const vision::MarkerOptions& marker) {
  if (checks_) checks_->setMarker(marker);
}

void CameraStrip::see(const tracking::StereoFrame& frame, const tracking::Snapshot& snapshot) {
  if (!checks_ || (seen_.isValid() && seen_.elapsed() < kSeePeriod)) return;
  seen_.start();
  checks_->see(frame, snapshot);
  for (std::size_t side = 0; side < 2; ++side) brightness_[side]->showExposure(checks_->exposures()[side]);
  if (!refreshed_.isValid() || refreshed_.elapsed() >= kRefreshPeriod) refresh();
}

void CameraStrip::observe(const tracking::Snapshot& snapshot) {
  if (checks_) checks_->observe(snapshot);
}

void CameraStrip::setNow(double t, const std::vector<tracking::SideStatus>& sides) {
  if (!checks_) return;
  checks_->setNow(t, sides);
  if (!refreshed_.isValid() || refreshed_.elapsed() >= kRefreshPeriod) refresh();
}

void CameraStrip::refresh() {
  refreshed_.start();
  shown_ = checks_ ? checks_->checks() : std::vector<CameraCheck>{};
  QStringList remedies;
  QString button;
  for (std::size_t i = 0; i < shown_.size() && i < kChecks; ++i) {
    const CameraCheck& check = shown_[i];
    const bool fails = check.state == CheckState::kFail;
    labels_[i]->setText(lineOf(check));
    labels_[i]->setToolTip(shown(check.remedy));
    restyle(*labels_[i], QString("color: %1; font-weight: %2;")
                             .arg((fails                                 ? theme_.inkOf(theme_.warning)
                                   : check.state == CheckState::kUnknown ? theme_.muted
                                                                         : theme_.text)
                                      .name(),
                                  fails ? "bold" : "normal"));
    if (!check.remedy.empty()) remedies << shown(check.remedy);
    if (!check.button.empty()) button = shown(check.button);
  }
  remedies_->setText(remedies.join('\n'));
  button_->setText(button);
  button_->setVisible(!button.isEmpty());
  notice_->setVisible(!remedies.isEmpty());
}

QString CameraStrip::text(const QString& name) const {
  for (const CameraCheck& check : shown_)
    if (shown(check.name) == name) return lineOf(check);
  return {};
}

QString CameraStrip::remedies() const { return notice_->isHidden() ? QString() : remedies_->text(); }

}  // namespace capstan::widgets
