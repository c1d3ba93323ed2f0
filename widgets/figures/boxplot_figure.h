#pragma once

#include <optional>
#include <vector>

#include "core/stats/boxplot.h"
#include "widgets/figures/panel_figure.h"
#include "widgets/figures/series_style.h"

namespace capstan::widgets {

class BoxSeries;

struct BoxplotBox {
  SeriesKey key;
  stats::Boxplot statistics;  ///< statistics in the panel's unit; n = 0: no data
};

struct BoxplotGroup {
  QString label;  ///< for example a trial "1" or a percentage "10"
  std::vector<BoxplotBox> boxes;
};

struct BoxplotPanel {
  QString title, unit;
  QString x_label;  ///< what the groups differ in: "trial", "occlusion [%]"
  std::vector<BoxplotGroup> groups = {};
};

struct BoxplotData {
  QString title = {}, note = {};
  QString quantity = QStringLiteral("error");  ///< on the value axes; empty: the title of each panel
  std::vector<BoxplotPanel> panels = {};
  int most_columns = 0;  ///< largest number of panels side by side; 0: as many as fit
};

/// Box-plot statistics of the finite `values`; those that are not finite are excluded. n = 0 where none is
/// finite.
stats::Boxplot boxplotOf(const std::vector<double>& values);

/// Box plots of groups side by side (UKF paper, figures 10–13): Tukey's box, whiskers within 1.5
/// interquartile ranges, outliers, the median as a number, the number of samples below each group. At most
/// kMostOutliers outliers of a box are drawn, always with the two extreme ones; the note gives their number.
/// The value axis covers outliers up to one range of the whiskers beyond these; farther ones are counted at
/// its edge.
class BoxplotFigure : public PanelFigure {
  Q_OBJECT
 public:
  static constexpr std::size_t kMostOutliers = 100;

  explicit BoxplotFigure(BoxplotData data, QWidget* parent = nullptr);

  std::unique_ptr<Figure> copy() const override;
  std::vector<FigureNumbers> numbers() const override;
  const BoxplotData& data() const { return data_; }
  /// Number of outliers drawn, as the note gives it; empty where all are drawn.
  QString outlierWords() const;

 protected:
  int columnsFor(QSize size) const override;
  void restyle() override;
  void laidOut() override;
  int leastHeight(std::size_t panel) const override;

 private:
  void build();
  void buildPanel(const BoxplotPanel& panel);
  void labelGroups(std::size_t panel);

  BoxplotData data_;
  struct Drawn {
    std::vector<std::pair<SeriesKey, BoxSeries*>> series;
    QCPRange values;    ///< visible values
    double slot = 0.0;  ///< width of a box on the bottom axis
  };
  std::vector<Drawn> drawn_;
  std::size_t outliers_ = 0, outliers_drawn_ = 0;
};

/// At most `most` of the ascending `values`, evenly spaced by index, with both ends.
std::vector<double> thinned(const std::vector<double>& values, std::size_t most);

}  // namespace capstan::widgets
