#pragma once

#include <QColor>
#include <QFont>
#include <QPen>
#include <QString>

class QApplication;

namespace capstan::widgets {

/// Quantity that a curve, a number or a drawing shows. Each quantity has the same colour everywhere.
enum class Quantity { kTrue, kKinematic, kCamera, kUkf };

/// Name of a quantity as legends and tables write it.
QString nameOf(Quantity quantity);

/// Colours of one theme. Quantities have Okabe–Ito colours (safe for colour-blind people), the same in both
/// themes except the truth, which is black on light and white on dark. All other colours are quiet, with one
/// accent.
struct Theme {
  static constexpr double kLeastContrast = 4.5;  ///< of text (WCAG 2.1, level AA)

  QString name;      ///< "dark" or "light"
  QColor window;     ///< behind everything
  QColor surface;    ///< panels, plots, fields
  QColor raised;     ///< buttons, headers
  QColor border;     ///< hairlines
  QColor grid;       ///< grid lines of plots
  QColor text;       ///< at least 7:1 on surface
  QColor muted;      ///< second-rank text, at least 4.5:1 on surface
  QColor accent;     ///< focus, selection, running
  QColor on_accent;  ///< text on the accent colour
  QColor warning;    ///< amber, always with a word
  QColor fault;      ///< reddish purple, always with a word
  QColor occluded;   ///< shade of occluded time
  QColor truth;      ///< colour of Quantity::kTrue

  static const Theme& dark();
  static const Theme& light();
  /// The theme of this name; the dark one for any other text.
  static const Theme& named(const QString& name);

  bool isDark() const { return name == QLatin1String("dark"); }
  QColor colour(Quantity quantity) const;
  /// `colour` as text: darker in the light theme, lighter in the dark one, as far as its contrast on every
  /// background (window, surface, raised) needs it to be kLeastContrast.
  QColor inkOf(const QColor& colour) const;
  /// The quantity's pen, the same in every plot: true thin and solid, kinematic dashed, UKF thick and solid.
  /// Thick lines are drawn below thin ones (UKF, kinematic, true), so that each stays visible where they
  /// coincide. The camera has marks, not a line: Qt::NoPen with its colour.
  QPen pen(Quantity quantity) const;
  /// Fill colour of the filter's ±2σ band.
  QColor band() const;
};

/// Contrast ratio of two colours, 1…21 (WCAG 2.1).
double contrastOf(const QColor& a, const QColor& b);

/// Fonts of text and of numbers; `points`: size [typographic points].
QFont textFont(double points, bool bold = false);
QFont numberFont(double points, bool bold = false);

/// Style sheet of a notice: raised background with an edge in `edge` at its left.
QString noticeStyle(const Theme& theme, const QColor& edge);
/// Sets a widget's style sheet if it differs. Qt computes the styles of a widget and its children again even
/// for an equal style sheet.
void restyle(QWidget& widget, const QString& style_sheet);

/// Sets palette, style sheet and font of the whole program.
void applyTheme(QApplication& application, const Theme& theme);

}  // namespace capstan::widgets
