#pragma once

#include <QPainter>
#include <QPen>
#include <QString>

#include "widgets/figures/hatch.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// Whose numbers a box or a histogram shows: a quantity, and which run where two are compared.
struct SeriesKey {
  Quantity quantity = Quantity::kUkf;
  int run = 0;            ///< 0 the first, 1 the second
  QString run_name = {};  ///< shown beside the quantity; empty: a single run
  QString words = {};     ///< in the quantity's place; empty: its own name

  QString name() const;
  bool operator==(const SeriesKey&) const = default;
};

/// How a series fills an area: its quantity's colour, distinguished in grey by hatch, outline and mark. The
/// UKF is filled plainly, kinematics are hatched and outlined with dashes, the camera is hatched the other
/// way and dotted; a second run is paler and hatched across.
struct SeriesStyle {
  QColor ink, fill;
  Hatch hatch = Hatch::kNone, second_hatch = Hatch::kNone;
  Qt::PenStyle outline = Qt::SolidLine;
  bool filled_mark = true;  ///< of outliers: a disc, else a circle

  static SeriesStyle of(const SeriesKey& key, const Theme& theme);
  QPen pen(double width) const;
  /// Fill and hatches of one box, without outline. `unit` [px]: a width of lines, from which the hatch takes
  /// its measure.
  void fillBox(QPainter* painter, const QRectF& box, double unit) const;
};

}  // namespace capstan::widgets
