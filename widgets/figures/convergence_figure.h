#pragma once

#include <optional>
#include <vector>

#include "widgets/figures/panel_figure.h"
#include "widgets/figures/sigma_band.h"
#include "widgets/figures/time_shade.h"

namespace capstan::widgets {

/// Estimate of one parameter over time, in `unit`.
struct ConvergencePanel {
  QString title;                                       ///< for example "radius r_l of joint 1"
  QString unit;                                        ///< for example "mm"
  std::vector<double> t = {}, value = {}, sigma = {};  ///< all of the same length; t [s]; NaN: a gap
  double nominal = 0.0;
  std::optional<double> truth = {};       ///< true value, where known
  std::optional<double> settled_at = {};  ///< time of settling [s]; none: not settled
  bool seen = true;                       ///< false: not observable from the motion
  int group = -1;                         ///< panels of one group share a page; −1: a group of its own
};

struct ConvergenceData {
  QString title = {}, note = {};
  std::vector<ConvergencePanel> panels = {};
  std::vector<TimeInterval> occluded = {};  ///< occluded intervals, shaded in every panel
};

/// Parameters over time during identification (UKF paper, figures 6 and 7): value ± 2σ, true and nominal
/// value as lines, a mark at the time of settling, the last value above. The value axis includes all values
/// and lines, and the part of the band after the first fifth of the time.
class ConvergenceFigure : public PanelFigure {
  Q_OBJECT
 public:
  explicit ConvergenceFigure(ConvergenceData data, QWidget* parent = nullptr);

  std::unique_ptr<Figure> copy() const override;
  std::vector<FigureNumbers> numbers() const override;
  const ConvergenceData& data() const { return data_; }

 protected:
  int columnsFor(QSize size) const override;
  bool sharesX() const override;
  void restyle() override;

 private:
  void build(const ConvergencePanel& data);
  QString words(const ConvergencePanel& panel) const;

  ConvergenceData data_;
  struct Curves {
    SigmaBand* band;
    QCPGraph* value;
    QCPItemLine *nominal, *truth, *settled;
  };
  std::vector<Curves> curves_;
  std::vector<TimeShade*> shades_;
};

}  // namespace capstan::widgets
