// What a drawing of the joint figure depends on, and whether it is worth drawing again.
#include <algorithm>
#include <cmath>

#include "widgets/figures/joint_figure.h"

namespace capstan::widgets {

/// New samples move a long time axis by less than half a pixel: drawing them can wait.
bool JointFigure::barelyMoved(const View& view) const {
  View same = view;
  same.time = drawn_.time;
  same.begin = drawn_.begin;
  same.detail = drawn_.detail;
  same.block = drawn_.block;
  same.revision = drawn_.revision;
  same.newest = drawn_.newest;
  const double pixel = view.time.size() / std::max(width(), 1);
  return following_ && same == drawn_ &&
         std::abs(view.time.size() - drawn_.time.size()) < 1e-9 * view.time.size() &&
         std::abs(view.time.upper - drawn_.time.upper) < 0.5 * pixel &&
         std::abs(view.newest - drawn_.newest) < 0.5 * pixel && since_drawn_.elapsed() < kRest;
}

JointFigure::View JointFigure::viewOf(const QCPRange& time) const {
  View view{.time = time,
            .values = {},
            .size = size(),
            .theme = theme_,
            .cursor = pointer_ ? std::nullopt : cursor_,
            .pointer = pointer_,
            .begin = std::max(history_->begin(), time.lower),
            .detail = std::clamp(history_->detailBegin(), time.lower, time.upper),
            .block = history_->blockAt(std::max(history_->begin(), time.lower)),
            .revision = history_->end() <= time.upper ? history_->revision() : 0,
            .newest = history_->end() <= time.upper ? history_->end() : 0.0};
  for (std::size_t i = 0; i < plots_.size(); ++i)
    view.values[i] = plots_[i]->axes()->axis(QCPAxis::atLeft)->range();
  return view;
}

}  // namespace capstan::widgets
