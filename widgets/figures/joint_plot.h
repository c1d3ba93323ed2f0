#pragma once

#include <qcustomplot.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "widgets/figures/curve.h"
#include "widgets/figures/detail_mark.h"
#include "widgets/figures/figure_header.h"
#include "widgets/figures/joint_history.h"
#include "widgets/figures/occlusion_shade.h"
#include "widgets/figures/sigma_band.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// Curves of one joint in one axis rect: true, kinematic, UKF with its ±2σ band, camera dots. The QCustomPlot
/// owns the graphical items; this class controls them.
class JointPlot {
 public:
  /// `joint` 0…2.
  JointPlot(QCustomPlot* plot, const JointHistory& history, int joint);

  /// Sets title and unit, as "shoulder" and "deg", written `shoulder q1 [deg]`. `fault`: description of a
  /// fault in the values, after the title.
  void setTitle(const QString& title, const QString& unit, const QString& fault = {});
  /// Sets the colours. `vectors`: draws dots as circles, for files; otherwise as copies of a small image, for
  /// speed. `widths`: factor on lines, dashes and dots.
  void setTheme(const Theme& theme, bool vectors, double widths = 1.0);
  void setTickPoints(double points);

  /// Sets another history, which must outlive the plot, and the least range of the value axis.
  void setHistory(const JointHistory& history, double least_range);
  /// Draws the UKF of a second history over the first, dashed in the accent colour; null: no second one.
  void setSecond(const JointHistory* history);
  /// Shows or hides a curve; the band belongs to the UKF. The value axis fits the curves shown.
  void setShown(Quantity quantity, bool on);
  bool shown(Quantity quantity) const { return graph(quantity)->visible(); }

  /// Sets the largest number of camera dots drawn. Beyond it, the lowest and the highest dot of `most` blocks
  /// are drawn.
  void setMostDots(std::size_t most) { most_dots_ = std::max<std::size_t>(most, 1); }

  /// Reads the curves of [begin, end] from the history, with at most `most` steps.
  void fill(double begin, double end, std::size_t most);
  /// Writes the four values at t into the header, or blanks.
  void showValuesAt(double t, double camera_reach);
  /// Writes the differences of the values between `from` and `to` into the header.
  void showDifferences(double from, double to, double camera_reach);
  /// Fits the value axis to the curves drawn: it grows at once, and shrinks when half of it is empty.
  void fitValues();
  void setFitting(bool on) { fitting_ = on; }
  bool fitting() const { return fitting_; }
  /// Range of the values that fill() read last, without bands; none: no value.
  std::optional<QCPRange> drawn() const { return any_ ? std::optional(drawn_) : std::nullopt; }

  QCPAxisRect* axes() const { return axes_; }
  const OcclusionShade& shade() const { return *shade_; }
  const DetailMark& detailMark() const { return *detail_mark_; }
  FigureHeader* header() const { return header_; }
  QCPGraph* second() const { return second_graph_; }
  QCPGraph* graph(Quantity quantity) const { return graphs_[static_cast<std::size_t>(quantity)]; }
  const SigmaBand& band() const { return *band_; }

 private:
  using Readout = std::array<double, 5>;  ///< by Quantity, then 2σ of the UKF; NaN: unknown
  Readout readoutAt(double t, double camera_reach) const;
  void include(Quantity quantity, float value);
  bool fillsArea() const;
  void useThinPens(bool on);
  void chooseTicks();
  void fillCamera(double begin, double end);
  void fillSecond(double begin, double end, std::size_t most);

  const JointHistory* history_;
  int joint_;
  QCPAxisRect* axes_;
  FigureHeader* header_;
  OcclusionShade* shade_;
  DetailMark* detail_mark_;
  std::array<QCPGraph*, 4> graphs_{};
  QCPGraph* casing_;  ///< background-coloured edge of each dash: separates dash from line in grey print
  SigmaBand* band_;
  std::map<QCPGraph*, QPen> pens_;  ///< of the lines, where they fill no area
  bool on_screen_ = true, area_ = false;
  const JointHistory* second_ = nullptr;
  QCPGraph* second_graph_;
  CurveBuilder second_line_;
  CurveBuilder truth_, kinematic_, ukf_;
  QVector<QCPGraphData> dashed_, camera_;
  QCPRange drawn_;  ///< range of the values drawn last
  bool any_ = false;
  bool fitting_ = true;
  double least_range_ = 1.0;
  double widths_ = 1.0;
  std::size_t most_dots_ = 700;
};

}  // namespace capstan::widgets
