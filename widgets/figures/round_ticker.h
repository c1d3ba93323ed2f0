#pragma once

#include <qcustomplot.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "widgets/figures/number_text.h"

namespace capstan::widgets {

/// Ticks at 1, 2 or 5 times a power of ten, at least two of them. Labels have exactly the decimals that the
/// step needs and a true minus sign.
class RoundTicker : public QCPAxisTicker {
 public:
  /// The step for about `count` ticks.
  static double stepFor(const QCPRange& range, int count) {
    const double rough = range.size() / std::max(count, 1);
    const double decade = std::pow(10.0, std::floor(std::log10(rough)));
    const double share = rough / decade;
    constexpr std::array kSteps = {10.0, 5.0, 2.0, 1.0, 0.5, 0.2, 0.1};
    std::size_t chosen = share < 1.4 ? 3 : share < 3.2 ? 2 : share < 7.0 ? 1 : 0;
    while (chosen + 1 < kSteps.size() && ticksWithin(range, decade * kSteps[chosen]) < 2.0) ++chosen;
    return decade * kSteps[chosen];
  }
  /// A range of values widened so that ticks are at its ends.
  struct Ends {
    QCPRange range;
    double step = 1.0;
  };
  /// The narrowest range about `values` with at most `most` steps from its first tick to its last; steps are
  /// 1 to 5 times a power of ten. Values may exceed these ticks by 15 % of a step.
  static Ends endsFor(const QCPRange& values, int most) {
    constexpr double kBeyond = 0.15;  // of a step
    const double least = std::pow(10.0, std::floor(std::log10(values.size() / std::max(most, 1))) - 1.0);
    Ends best;
    for (double decade = least; decade < 1e4 * least; decade *= 10.0)
      for (const double share : {1.0, 2.0, 3.0, 4.0, 5.0}) {
        const double step = share * decade;
        const double first = std::floor(values.lower / step + kBeyond),
                     last = std::ceil(values.upper / step - kBeyond);
        if (last <= first || last - first > std::max(most, 1)) continue;
        const QCPRange range(std::min(step * first, values.lower), std::max(step * last, values.upper));
        if (best.range.size() == 0.0 || range.size() < 0.999 * best.range.size()) best = {range, step};
      }
    return best;
  }
  /// Sets the step; 0: as stepFor().
  void setFixedStep(double step) { fixed_step_ = step; }

 protected:
  double getTickStep(const QCPRange& range) override {
    return useStep(fixed_step_ > 0.0 ? fixed_step_ : stepFor(range, tickCount()));
  }
  /// Sets the step of the labels and returns it.
  double useStep(double step) { return step_ = step; }
  int getSubTickCount(double) override { return 0; }
  QString getTickLabel(double tick, const QLocale& locale, QChar, int) override {
    return withMinus(locale.toString(std::abs(tick) < 1e-9 * step_ ? 0.0 : tick, 'f', decimals()));
  }
  /// Number of decimals that the step needs.
  int decimals() const { return std::max(0, -static_cast<int>(std::floor(std::log10(step_) + 1e-9))); }

 private:
  static double ticksWithin(const QCPRange& range, double step) {
    return std::floor(range.upper / step) - std::ceil(range.lower / step) + 1.0;
  }

  double step_ = 1.0, fixed_step_ = 0.0;
};

/// RoundTicker with additional ticks at the ends of the axis (rounded inwards to the last decimal). They
/// replace ticks that are closer to an end than 70 % of a step. For an axis that ends with its data. Where a
/// step leads from one end to the other, as 5 from 15 to 35, all ticks are equally far apart.
class EndTicker : public RoundTicker {
 protected:
  double getTickStep(const QCPRange& range) override {
    const double usual = stepFor(range, tickCount());
    for (const double share : {1.0, 2.0, 2.5, 4.0, 5.0})  // of a usual step of 1, 2 or 5: again round
      if (const double step = share * usual; isRound(step) && leads(range, step)) return useStep(step);
    return useStep(usual);
  }
  QVector<double> createTickVector(double step, const QCPRange& range) override {
    constexpr double kClose = 0.7;  // of a step
    const double unit = std::pow(10.0, -decimals());
    const double first = unit * std::ceil(range.lower / unit - 1e-9);
    const double last = unit * std::floor(range.upper / unit + 1e-9);
    QVector<double> ticks = RoundTicker::createTickVector(step, range);
    const auto near = [&](double tick) {
      return tick < first + kClose * step || tick > last - kClose * step;
    };
    ticks.erase(std::remove_if(ticks.begin(), ticks.end(), near), ticks.end());
    ticks.prepend(first);
    if (last > first) ticks.append(last);
    return ticks;
  }

 private:
  /// Whether both ends are multiples of the step, with a tick between them.
  static bool leads(const QCPRange& range, double step) {
    const auto is = [&](double value) { return std::abs(value / step - std::round(value / step)) < 1e-6; };
    return is(range.lower) && is(range.upper) && range.size() > 1.5 * step;
  }
  /// 1, 2 or 5 times a power of ten.
  static bool isRound(double step) {
    const double share = step / std::pow(10.0, std::floor(std::log10(step) + 1e-9));
    return std::any_of(kRound.begin(), kRound.end(),
                       [&](double round) { return std::abs(share - round) < 1e-6; });
  }
  static constexpr std::array kRound = {1.0, 2.0, 5.0};
};

}  // namespace capstan::widgets
