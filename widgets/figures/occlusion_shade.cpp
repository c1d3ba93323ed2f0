#include "widgets/figures/occlusion_shade.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace capstan::widgets {

namespace {

constexpr double kGap = 4.0;  ///< gap around the word [px]
constexpr std::size_t kMostRows = 400;

}  // namespace

OcclusionShade::OcclusionShade(QCPAxisRect* axes, const JointHistory& history, int joint)
    : QCPLayerable(axes->parentPlot(), QStringLiteral("background"), axes),
      axes_(axes),
      history_(&history),
      joint_(static_cast<std::size_t>(joint)) {}

void OcclusionShade::setTheme(const Theme& theme) {
  shade_ = theme.occluded;
  ink_ = theme.muted;
}

/// Occlusions that touch on the screen are drawn as one shade: overlapping shades would become dark.
void OcclusionShade::draw(QCPPainter* painter) {
  drawn_ = 0;
  labels_.clear();
  const QCPAxis* time = axes_->axis(QCPAxis::atBottom);
  const QCPRange range = time->range();
  const QRect area = axes_->rect();
  painter->setFont(textFont(9.0));
  std::optional<QRectF> box;
  history_->forEachOcclusion(range.lower, range.upper, kMostRows, [&](double begin, double end) {
    const double left = std::max<double>(time->coordToPixel(begin), area.left());
    const double right = std::min<double>(time->coordToPixel(end), area.right() + 1);
    if (box && left > box->right()) drawBox(painter, *std::exchange(box, std::nullopt));
    const QRectF next(left, area.top(), std::max(right - left, 1.0), area.height());
    box = box ? box->united(next) : next;
  });
  if (box) drawBox(painter, *box);
}

void OcclusionShade::drawBox(QCPPainter* painter, const QRectF& box) {
  painter->fillRect(box, shade_);
  ++drawn_;
  if (joint_ != 0) return;
  const QString word = QObject::tr("occluded");
  const auto place = placeFor(QFontMetricsF(painter->font()).size(Qt::TextSingleLine, word), box);
  if (!place) return;
  painter->setPen(ink_);
  painter->drawText(*place, Qt::AlignCenter | Qt::TextDontClip, word);
  labels_.push_back(*place);
}

std::optional<QRectF> OcclusionShade::placeFor(const QSizeF& word, const QRectF& box) const {
  if (box.width() < word.width() + 2.0 * kGap) return std::nullopt;
  QRectF place(QPointF(box.left() + kGap, box.top() + 0.5 * kGap), word);
  const QCPAxis* time = axes_->axis(QCPAxis::atBottom);
  const QCPAxis* value = axes_->axis(QCPAxis::atLeft);
  const auto values =
      valuesWithin(time->pixelToCoord(place.left() - kGap), time->pixelToCoord(place.right() + kGap));
  if (!values) return place;
  const double highest = value->coordToPixel(values->upper), lowest = value->coordToPixel(values->lower);
  if (place.bottom() < highest || place.top() > lowest) return place;
  place.moveBottom(box.bottom() - 0.5 * kGap);
  if (place.top() > lowest || place.bottom() < highest) return place;
  return std::nullopt;
}

std::optional<QCPRange> OcclusionShade::valuesWithin(double begin, double end) const {
  float least = std::numeric_limits<float>::infinity(), most = -least;
  const auto include = [&](float value) {
    least = std::fmin(least, value);  // fmin and fmax pass over NaN
    most = std::fmax(most, value);
  };
  history_->forEach(begin, end, kMostRows, [&](double, double, const auto& lows, const auto& highs) {
    const JointValues &low = lows[joint_], &high = highs[joint_];
    for (const float value : {low.truth, high.truth, low.kinematic, high.kinematic, low.ukf, high.ukf,
                              low.ukf - 2.0F * high.ukf_sigma, high.ukf + 2.0F * high.ukf_sigma})
      include(value);
  });
  history_->forEachCamera(begin, end, kMostRows, [&](double, double, const auto& low, const auto& high) {
    include(low[joint_]);
    include(high[joint_]);
  });
  if (!(least <= most)) return std::nullopt;
  return QCPRange(static_cast<double>(least), static_cast<double>(most));
}

}  // namespace capstan::widgets
