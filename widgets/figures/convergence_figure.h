#pragma once

#include <optional>
#include <vector>

#include "widgets/figures/panel_figure.h"
#include "widgets/figures/sigma_band.h"
#include "widgets/figures/time_shade.h"

namespace capstan::widgets {

/// One parameter's estimate over time, in `unit`.
struct ConvergencePanel {
  QString title;                                       ///< as "radius r_l of joint 1"
  QString unit;                                        ///< as "mm"
  std::vector<double> t = {}, value = {}, sigma = {};  ///< of one length; t [s]; NaN: a gap
  double nominal = 0.0;
  std::optional<double> truth = {};       ///< where it is known
  std::optional<double> settled_at = {};  ///< [s]; none: it did not settle
  bool seen = true;                       ///< false: the motion does not show it, its value says nothing
  int group = -1;                         ///< panels of one group stand on one page; −1: a group of its own
};

struct ConvergenceData {
  QString title = {}, note = {};
  std::vector<ConvergencePanel> panels = {};
  std::vector<TimeInterval> occluded = {};  ///< shaded in every panel
};

/// Parameters over time while they are identified (UKF paper, figures 6 and 7): value ± 2σ, truth and nominal
/// value as lines, the time since which it has been settled as a mark, the last value above. The value axis
/// shows values and lines whole, and of the band what it is after the first fifth of the time.
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
