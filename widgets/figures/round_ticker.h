#pragma once

#include <qcustomplot.h>

#include <algorithm>
#include <cmath>

namespace capstan::widgets {

/// Ticks at 1, 2 or 5 times a power of ten, labelled with exactly the decimals that the step needs.
class RoundTicker : public QCPAxisTicker {
 protected:
  double getTickStep(const QCPRange& range) override {
    const double rough = range.size() / std::max(tickCount(), 1);
    const double decade = std::pow(10.0, std::floor(std::log10(rough)));
    const double share = rough / decade;
    step_ = decade * (share < 1.4 ? 1.0 : share < 3.2 ? 2.0 : share < 7.0 ? 5.0 : 10.0);
    return step_;
  }
  int getSubTickCount(double) override { return 0; }
  QString getTickLabel(double tick, const QLocale& locale, QChar, int) override {
    const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step_) + 1e-9)));
    return locale.toString(std::abs(tick) < 1e-9 * step_ ? 0.0 : tick, 'f', decimals);
  }

 private:
  double step_ = 1.0;
};

}  // namespace capstan::widgets
