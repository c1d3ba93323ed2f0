#pragma once

#include <array>
#include <vector>

#include "widgets/figures/panel_figure.h"
#include "widgets/figures/pose_source.h"
#include "widgets/figures/time_shade.h"

namespace capstan::widgets {

/// Data of one trajectory: positions in mm, angles in degrees, unwrapped.
struct PoseTraceData {
  QString title = {}, note = {};
  std::vector<double> t = {};       ///< [s]
  std::vector<bool> rejected = {};  ///< one flag per observation
  /// Values as [source of kCommanded, kOffset, kCorrected][x, y, z, yaw, pitch, roll]; empty: not available.
  std::array<std::array<std::vector<double>, 6>, 3> history = {};
};

/// A trajectory over time: commanded, observed with the rigid offset, and corrected (GPR paper, figure 4).
/// Excluded observations are marked in the colour of warnings.
class PoseTraceFigure : public PanelFigure {
  Q_OBJECT
 public:
  static constexpr std::array kSources = {PoseSource::kCommanded, PoseSource::kOffset,
                                          PoseSource::kCorrected};

  explicit PoseTraceFigure(PoseTraceData data, QWidget* parent = nullptr);

  std::unique_ptr<Figure> copy() const override;
  std::vector<FigureNumbers> numbers() const override;
  const PoseTraceData& data() const { return data_; }

 protected:
  int columnsFor(QSize size) const override;
  bool sharesX() const override { return true; }
  void restyle() override;

 private:
  struct Curves {
    std::array<QCPGraph*, 3> history;
    QCPGraph* rejected;
  };
  void build(std::size_t degree);
  QPen penOf(PoseSource source) const;

  PoseTraceData data_;
  std::vector<Curves> curves_;
  std::vector<TimeShade*> gaps_;
};

}  // namespace capstan::widgets
