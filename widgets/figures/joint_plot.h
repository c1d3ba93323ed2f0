#pragma once

#include <qcustomplot.h>

#include <algorithm>
#include <array>
#include <optional>

#include "widgets/figures/curve.h"
#include "widgets/figures/detail_mark.h"
#include "widgets/figures/figure_header.h"
#include "widgets/figures/joint_history.h"
#include "widgets/figures/occlusion_shade.h"
#include "widgets/figures/sigma_band.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// Curves of one joint in one axis rect: true, kinematic, UKF with its ±2σ band, camera dots. Owned by the
/// QCustomPlot it draws in; this class only steers.
class JointPlot {
 public:
  /// `joint` 0…2.
  JointPlot(QCustomPlot* plot, const JointHistory& history, int joint);

  /// As people read them: "shoulder", "deg"; written once, as `shoulder q1 [deg]`. `fault`: what is wrong
  /// with its values, behind the title.
  void setTitle(const QString& title, const QString& unit, const QString& fault = {});
  /// `vectors`: dots are drawn as circles, for files; else stamped from a small picture, for speed. `widths`
  /// scales lines, dashes and dots.
  void setTheme(const Theme& theme, bool vectors, double widths = 1.0);
  void setTickPoints(double points);

  /// Camera dots drawn at once; of more, the lowest and the highest of as many blocks.
  void setMostDots(std::size_t most) { most_dots_ = std::max<std::size_t>(most, 1); }

  /// Takes curves of [begin, end] at no more than `most` steps.
  void fill(double begin, double end, std::size_t most);
  /// Writes the four values at t, or blanks.
  void showValuesAt(double t, double camera_reach);
  /// Fits the value axis to what is drawn: grows at once, shrinks when half of it stands empty.
  void fitValues();
  void setFitting(bool on) { fitting_ = on; }
  bool fitting() const { return fitting_; }
  /// Of what fill() took last, without bands; nothing: no value.
  std::optional<QCPRange> drawn() const { return any_ ? std::optional(drawn_) : std::nullopt; }

  QCPAxisRect* axes() const { return axes_; }
  const OcclusionShade& shade() const { return *shade_; }
  const DetailMark& detailMark() const { return *detail_mark_; }
  FigureHeader* header() const { return header_; }
  QCPGraph* graph(Quantity quantity) const { return graphs_[static_cast<std::size_t>(quantity)]; }
  const SigmaBand& band() const { return *band_; }

 private:
  void include(double value);
  void chooseTicks();
  void fillCamera(double begin, double end);

  const JointHistory& history_;
  int joint_;
  QCPAxisRect* axes_;
  FigureHeader* header_;
  OcclusionShade* shade_;
  DetailMark* detail_mark_;
  std::array<QCPGraph*, 4> graphs_{};
  QCPGraph* casing_;  ///< the plot's ground about each dash: separates dash from line where both print grey
  SigmaBand* band_;
  CurveBuilder truth_, kinematic_, ukf_;
  QVector<QCPGraphData> dashed_, camera_;
  QCPRange drawn_;  ///< of values drawn last
  bool any_ = false;
  bool fitting_ = true;
  double widths_ = 1.0;
  std::size_t most_dots_ = 700;
};

}  // namespace capstan::widgets
