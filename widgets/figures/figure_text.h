#pragma once

#include <QString>
#include <cmath>
#include <limits>
#include <string>

#include "core/base/shown_number.h"
#include "widgets/figures/number_text.h"

namespace capstan::widgets {

inline constexpr double kPowersFrom = 1e7;  ///< numbers of this size and above are written with powers of ten

/// `value` with `digits` significant digits: fixed notation between 1e-3 and kPowersFrom, powers of ten
/// outside, a dash where it is not finite. The minus sign is U+2212.
inline QString significantText(double value, int digits = 3) {
  if (!std::isfinite(value)) return QStringLiteral("—");
  const double size = std::abs(value);
  QString text;
  if (size == 0.0)
    text = QStringLiteral("0");
  else if (size < 1e-3 || size >= kPowersFrom)
    text = QString::number(value, 'e', digits - 1);
  else
    text = QString::number(value, 'f', std::max(0, base::significantDecimals(size, digits)));
  return withMinus(text);
}

/// Value and uncertainty with the decimals that two digits of the uncertainty need: 59.02 ± 0.11.
inline QString uncertainText(double value, double uncertainty) {
  if (!std::isfinite(value) || !std::isfinite(uncertainty) || uncertainty <= 0.0)
    return significantText(value, 4);
  const int decimals = base::significantDecimals(uncertainty, 2);
  if (decimals > 8 || std::max(std::abs(value), uncertainty) >= kPowersFrom)
    return significantText(value, 4) + QStringLiteral(" ± ") + significantText(uncertainty, 2);
  const int shown = std::max(decimals, 0);
  return withMinus(QString::number(value, 'f', shown) + QStringLiteral(" ± ") +
                   QString::number(uncertainty, 'f', shown));
}

/// `text` with non-breaking spaces, so that a line is wrapped only between such texts.
inline QString unbroken(QString text) { return text.replace(QLatin1Char(' '), QChar(0x00A0)); }

/// `text` as a CSV cell (RFC 4180).
std::string csvText(const QString& text);
/// `value` with all its digits; an empty text for NaN.
std::string csvNumber(double value);

}  // namespace capstan::widgets
