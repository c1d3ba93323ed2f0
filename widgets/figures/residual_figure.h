#pragma once

#include <vector>

#include "core/diagnosis/report/report.h"
#include "widgets/figures/panel_figure.h"
#include "widgets/figures/sigma_band.h"
#include "widgets/figures/time_shade.h"

namespace capstan::widgets {

/// Measured and simulated values of a channel by the three models, in SI; all vectors of the same length, t
/// rising.
struct ResidualTrace {
  std::string channel, unit;  ///< "q2", "rad"
  double noise = 0.0;         ///< standard deviation of the sensor
  double period = 0.0;        ///< typical period between samples [s]; longer ones are gaps
  std::vector<double> t, measured, nominal, refitted;
  std::vector<double> extended = {};  ///< empty: no cause was added
  diagnosis::ChannelStatistics nominal_statistics = {}, refitted_statistics = {}, extended_statistics = {};
};

struct ResidualData {
  QString title = {}, note = {};
  std::vector<ResidualTrace> traces = {};
};

ResidualTrace residualTrace(const diagnosis::ChannelReport& channel, bool extended);
/// Data of one channel; `report` gives the name of the recording, the explained share and whether causes were
/// added.
ResidualData residualData(const diagnosis::Report& report, const diagnosis::ChannelReport& channel);

/// A channel over time: measured, and simulated by the nominal, the refitted and the extended model. Below it
/// the residuals of the last two, measured − simulated, over ± 2 σ of the sensor's noise. Above it RMS and
/// fit. The time axes move together when one is dragged or zoomed (the caller enables this by
/// setInteractions()).
///     ResidualFigure figure(residualData(report, report.channels[0]));
class ResidualFigure : public PanelFigure {
  Q_OBJECT
 public:
  explicit ResidualFigure(ResidualData data, QWidget* parent = nullptr);

  std::unique_ptr<Figure> copy() const override;
  /// Numbers of the figure; a long recording is thinned to at most kMostRows evenly spaced samples.
  std::vector<FigureNumbers> numbers() const override;
  static constexpr std::size_t kMostRows = 5000;
  const ResidualData& data() const { return data_; }

  enum class Line { kMeasured, kNominal, kRefitted, kExtended };

 protected:
  int columnsFor(QSize) const override { return 1; }
  bool sharesX() const override { return true; }
  void restyle() override;

 private:
  struct Curve {
    Line line;
    QCPGraph* graph;
    bool residual;  ///< true: measured − simulated; false: value over time
  };
  void build(const ResidualTrace& trace);
  void addLine(QCPAxisRect* axes, Line line, const ResidualTrace& trace, const std::vector<double>& values,
               bool residual);
  void linkTimes();
  QPen penOf(Line line, bool residual) const;

  ResidualData data_;
  std::vector<Curve> curves_;
  std::vector<SigmaBand*> noise_;
  std::vector<TimeShade*> gaps_;
};

}  // namespace capstan::widgets
