#include "widgets/video/stereo_view.h"

#include <QBoxLayout>
#include <algorithm>

#include "core/tracking/side_text.h"

namespace capstan::widgets {

StereoView::StereoView(QWidget* parent) : QWidget(parent), views_{new RoiView("LEFT"), new RoiView("RIGHT")} {
  auto* box = new QBoxLayout(QBoxLayout::TopToBottom, this);
  box->setContentsMargins(0, 0, 0, 0);
  box->setSpacing(1);
  for (auto* view : views_) {
    box->addWidget(view, 1);
    connect(view, &RoiView::wholeFrameLargeChanged, this, &StereoView::setWholeFrameLarge);
  }
}

void StereoView::setTheme(const Theme& theme) {
  for (auto* view : views_) view->setTheme(theme);
}

void StereoView::showFrames(const cv::Mat& left, const cv::Mat& right, const tracking::Snapshot& snapshot) {
  views_[0]->showFrame(left, snapshot.marker[0]);
  views_[1]->showFrame(right, snapshot.marker[1]);
}

void StereoView::clear(const QString& why) {
  for (auto* view : views_) view->clear(why);
}

void StereoView::setLines(const std::array<std::vector<ImageLine>, 2>& lines) {
  for (std::size_t side = 0; side < 2; ++side) views_[side]->setLines(lines[side]);
}

void StereoView::setOutdated(const std::vector<tracking::SideStatus>& sides) {
  left().setOutdated(QString::fromStdString(tracking::outdatedText(sides, "left")));
  right().setOutdated(QString::fromStdString(tracking::outdatedText(sides, "right")));
}

void StereoView::setWholeFrameLarge(bool large) {
  for (auto* view : views_) view->setWholeFrameLarge(large);
  arrange();
}

void StereoView::resizeEvent(QResizeEvent*) { arrange(); }

void StereoView::arrange() {
  // Whole frames are side by side if that makes them larger; regions are one above the other, so that their
  // insets have room beside them.
  constexpr double kLines = 56.0, kShape = 4.0 / 3.0;  // header and caption [px]; width by height of a frame
  const double beside = std::min(width() / 2.0, (height() - kLines) * kShape);
  const double above = std::min<double>(width(), (height() / 2.0 - kLines) * kShape);
  const bool wide = views_[0]->wholeFrameLarge() ? beside > above : width() > 2 * height();
  static_cast<QBoxLayout*>(layout())->setDirection(wide ? QBoxLayout::LeftToRight : QBoxLayout::TopToBottom);
}

}  // namespace capstan::widgets
