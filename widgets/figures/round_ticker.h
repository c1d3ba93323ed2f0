#pragma once

#include <qcustomplot.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace capstan::widgets {

/// Ticks at 1, 2 or 5 times a power of ten, at least two of them, labelled with exactly the decimals that the
/// step needs.
class RoundTicker : public QCPAxisTicker {
 protected:
  double getTickStep(const QCPRange& range) override {
    const double rough = range.size() / std::max(tickCount(), 1);
    const double decade = std::pow(10.0, std::floor(std::log10(rough)));
    const double share = rough / decade;
    constexpr std::array kSteps = {10.0, 5.0, 2.0, 1.0, 0.5, 0.2, 0.1};
    std::size_t chosen = share < 1.4 ? 3 : share < 3.2 ? 2 : share < 7.0 ? 1 : 0;
    while (chosen + 1 < kSteps.size() && ticksWithin(range, decade * kSteps[chosen]) < 2.0) ++chosen;
    step_ = decade * kSteps[chosen];
    return step_;
  }
  int getSubTickCount(double) override { return 0; }
  QString getTickLabel(double tick, const QLocale& locale, QChar, int) override {
    const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step_) + 1e-9)));
    return locale.toString(std::abs(tick) < 1e-9 * step_ ? 0.0 : tick, 'f', decimals);
  }

 private:
  static double ticksWithin(const QCPRange& range, double step) {
    return std::floor(range.upper / step) - std::ceil(range.lower / step) + 1.0;
  }

  double step_ = 1.0;
};

}  // namespace capstan::widgets
