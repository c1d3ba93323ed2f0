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
  stats::Boxplot statistics;  ///< in the panel's unit; n = 0: no data
};

struct BoxplotGroup {
  QString label;  ///< as "1" of a trial, "10" of a percentage
  std::vector<BoxplotBox> boxes;
};

struct BoxplotPanel {
  QString title, unit;
  QString x_label;  ///< what groups are: "trial", "occlusion [%]"
  std::vector<BoxplotGroup> groups = {};
};

struct BoxplotData {
  QString title = {}, note = {};
  QString quantity = QStringLiteral("error");  ///< of the value axes
  std::vector<BoxplotPanel> panels = {};
  int most_columns = 0;  ///< panels side by side at most; 0: as many as have room
};

/// Statistics of values of which some may not be finite, which are excluded; n = 0 where none are.
stats::Boxplot boxplotOf(const std::vector<double>& values);

/// Box plots of groups side by side (UKF paper, figures 10–13): Tukey's box, whiskers within 1.5
/// interquartile ranges, outliers, the median as a number, samples below each group. At most kMostOutliers of
/// a box are drawn, the extreme ones always; how many, the note says. The value axis reaches to three times
/// the whiskers' span beyond them: farther outliers are counted at its edge.
class BoxplotFigure : public PanelFigure {
  Q_OBJECT
 public:
  static constexpr std::size_t kMostOutliers = 100;

  explicit BoxplotFigure(BoxplotData data, QWidget* parent = nullptr);

  std::unique_ptr<Figure> copy() const override;
  std::vector<FigureNumbers> numbers() const override;
  const BoxplotData& data() const { return data_; }
  /// What the note says of outliers; empty where all are drawn.
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
    QCPRange values;    ///< of what is to be seen
    double slot = 0.0;  ///< width of a box on the bottom axis
  };
  std::vector<Drawn> drawn_;
  std::size_t outliers_ = 0, outliers_drawn_ = 0;
};

/// At most `most` of ascending values: the ends and evenly between.
std::vector<double> thinned(const std::vector<double>& values, std::size_t most);

}  // namespace capstan::widgets
