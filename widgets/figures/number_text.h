#pragma once

#include <QString>
#include <cmath>

namespace capstan::widgets {

/// Widest texts that valueText() and sigmaText() return.
inline const QString kWidestValue = QStringLiteral("−000.00"), kWidestSigma = QStringLiteral("±00.00");
inline const QString kSigmaName = QStringLiteral("±2σ");

/// `number` with a true minus sign (U+2212, as wide as a digit) in place of each hyphen.
inline QString withMinus(QString number) { return number.replace(QLatin1Char('-'), QChar(0x2212)); }

/// `value` with its sign: "+6.5" or "−6.5".
inline QString signedText(double value, int decimals) {
  return QChar(value < 0 ? 0x2212 : '+') + QString::number(std::abs(value), 'f', decimals);
}

/// `value` with two decimals if its integer part has up to three digits, without decimals up to five digits,
/// in powers of ten beyond; a dash where it is not finite. At most seven characters.
inline QString valueText(double value) {
  if (!std::isfinite(value)) return QStringLiteral("—");
  const double size = std::abs(value);
  return withMinus(size < 999.995   ? QString::number(value, 'f', 2)
                   : size < 99999.5 ? QString::number(value, 'f', 0)
                                    : QString::number(value, 'e', 0));
}

/// `value` with three decimals where its integer part has one digit, else as valueText().
inline QString errorText(double value) {
  return std::abs(value) < 9.9995 ? withMinus(QString::number(value, 'f', 3)) : valueText(value);
}

/// ± two standard deviations, in the same format. At most six characters below 1e100.
inline QString sigmaText(double two_sigma) {
  if (!std::isfinite(two_sigma)) return QStringLiteral("—");
  if (two_sigma < 99.995) return QStringLiteral("±%1").arg(two_sigma, 0, 'f', 2);
  return two_sigma < 9999.5 ? QStringLiteral("±%1").arg(two_sigma, 0, 'f', 0)
                            : QStringLiteral("±%1").arg(two_sigma, 0, 'e', 0);
}

}  // namespace capstan::widgets
