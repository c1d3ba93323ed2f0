#include "widgets/video/stereo_view.h"

#include <QBoxLayout>
#include <QResizeEvent>

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

void StereoView::setWholeFrameLarge(bool large) {
  for (auto* view : views_) view->setWholeFrameLarge(large);
}

void StereoView::resizeEvent(QResizeEvent* event) {
  const bool wide = event->size().width() > 2 * event->size().height();
  static_cast<QBoxLayout*>(layout())->setDirection(wide ? QBoxLayout::LeftToRight : QBoxLayout::TopToBottom);
}

}  // namespace capstan::widgets
