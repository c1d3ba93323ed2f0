#pragma once

#include <QPainter>
#include <QPen>
#include <QString>

#include "widgets/figures/hatch.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// Identity of a series in a box plot or histogram: a quantity and, where two runs are compared, the run.
struct SeriesKey {
  Quantity quantity = Quantity::kUkf;
  int run = 0;            ///< first run: 0, second run: 1
  QString run_name = {};  ///< name shown beside the quantity; empty: a single run
  QString words = {};     ///< name shown instead of the quantity's; empty: the quantity's

  QString name() const;
  bool operator==(const SeriesKey&) const = default;
};

/// Style of the area of a series: its quantity's colour; hatch, outline and mark distinguish series in grey
/// print. The UKF is filled plainly, kinematics are hatched with a dashed outline, the camera is hatched the
/// other way with a dotted outline. A second run is paler and cross-hatched.
struct SeriesStyle {
  QColor ink, fill;
  Hatch hatch = Hatch::kNone, second_hatch = Hatch::kNone;
  Qt::PenStyle outline = Qt::SolidLine;
  bool filled_mark = true;  ///< mark of outliers: disc (true) or circle

  static SeriesStyle of(const SeriesKey& key, const Theme& theme);
  QPen pen(double width) const;
  /// Draws fill and hatches of one box, without outline. `unit`: line width that scales the hatch [px].
  void fillBox(QPainter* painter, const QRectF& box, double unit) const;
};

}  // namespace capstan::widgets
