#pragma once

#include <QColor>
#include <QFont>
#include <QPen>
#include <QString>

class QApplication;

namespace capstan::widgets {

/// What a curve, a number or a drawing in the scene speaks of. One colour a quantity, everywhere.
enum class Quantity { kTrue, kKinematic, kCamera, kUkf };

/// Name of a quantity as legends and tables write it.
QString nameOf(Quantity quantity);

/// Colours of one theme. Quantities are Okabe–Ito (safe for colour-blind eyes), the same in both themes but
/// for the truth, which is black on light and white on dark; everything else is quiet, with one accent.
struct Theme {
  QString name;      ///< "dark" or "light"
  QColor window;     ///< behind everything
  QColor surface;    ///< panels, plots, fields
  QColor raised;     ///< buttons, headers
  QColor border;     ///< hairlines
  QColor grid;       ///< in plots
  QColor text;       ///< at least 7:1 on surface
  QColor muted;      ///< second-rank text, at least 4.5:1 on surface
  QColor accent;     ///< focus, selection, running
  QColor on_accent;  ///< text upon the accent
  QColor warning;    ///< amber, always with a word
  QColor fault;      ///< reddish purple, always with a word
  QColor occluded;   ///< shade of occluded time
  QColor truth;      ///< colour of Quantity::kTrue

  static const Theme& dark();
  static const Theme& light();
  /// By name; the dark one for any other text.
  static const Theme& named(const QString& name);

  bool isDark() const { return name == QLatin1String("dark"); }
  QColor colour(Quantity quantity) const;
  /// The quantity's line as every plot draws it: true thin and solid, kinematic dashed, UKF thick and solid.
  /// Drawn thick below thin (UKF, kinematic, true), each stays visible where they coincide.
  /// The camera has marks, not a line: Qt::NoPen with its colour.
  QPen pen(Quantity quantity) const;
  /// Fill of the filter's ±2σ.
  QColor band() const;
};

/// Text and number fonts; `points` in typographic points.
QFont textFont(double points, bool bold = false);
QFont numberFont(double points, bool bold = false);

/// Palette, style sheet and font of the whole program.
void applyTheme(QApplication& application, const Theme& theme);

}  // namespace capstan::widgets
