#pragma once

#include <vector>

#include "core/diagnosis/report/report.h"
#include "widgets/figures/panel_figure.h"
#include "widgets/figures/sigma_band.h"
#include "widgets/figures/time_shade.h"

namespace capstan::widgets {

/// A channel through the three models, in SI; all of one length, t rising.
struct RemainderTrace {
  std::string channel, unit;  ///< "q2", "rad"
  double noise = 0.0;         ///< standard deviation of the sensor
  double period = 0.0;        ///< between samples, typically [s]; longer without a sample is a gap
  std::vector<double> t, measured, nominal, refitted;
  std::vector<double> extended = {};  ///< empty: no cause was added
  diagnosis::ChannelStatistics nominal_statistics = {}, refitted_statistics = {}, extended_statistics = {};
};

struct RemainderData {
  QString title = {}, note = {};
  std::vector<RemainderTrace> traces = {};
};

RemainderTrace remainderTrace(const diagnosis::ChannelReport& channel, bool extended);
/// Of one channel: `report` says whether causes were added, and what the recording is called.
RemainderData remainderData(const diagnosis::Report& report, const diagnosis::ChannelReport& channel);

/// A channel over time: measured, and simulated by the nominal, the refitted and the extended model; below it
/// what the last two get wrong, measured − simulated, with ± 2 σ of the sensor's noise behind it. Above: RMS
/// and fit. The time axes go together when one is dragged or zoomed (setInteractions() is the caller's).
///     RemainderFigure figure(remainderData(report, report.channels[0]));
class RemainderFigure : public PanelFigure {
  Q_OBJECT
 public:
  explicit RemainderFigure(RemainderData data, QWidget* parent = nullptr);

  std::unique_ptr<Figure> copy() const override;
  /// Of long recordings every so-manieth sample, kMostRows at most.
  std::vector<FigureNumbers> numbers() const override;
  static constexpr std::size_t kMostRows = 5000;
  const RemainderData& data() const { return data_; }

  enum class Line { kMeasured, kNominal, kRefitted, kExtended };

 protected:
  int columnsFor(QSize) const override { return 1; }
  bool sharesX() const override { return true; }
  void restyle() override;

 private:
  struct Curve {
    Line line;
    QCPGraph* graph;
    bool remainder;  ///< measured − simulated; else over time
  };
  void build(const RemainderTrace& trace);
  void addLine(QCPAxisRect* axes, Line line, const RemainderTrace& trace, const std::vector<double>& values,
               bool remainder);
  void linkTimes();
  QPen penOf(Line line, bool remainder) const;

  RemainderData data_;
  std::vector<Curve> curves_;
  std::vector<SigmaBand*> noise_;
  std::vector<TimeShade*> gaps_;
};

}  // namespace capstan::widgets
