#pragma once

#include <QTreeWidget>

#include "core/diagnosis/report/report.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// RMS of every channel's residual on held-out data before and after the model is extended, with 95 %
/// intervals, drawn over one axis for angles and one for lengths. Below: the RMS errors of the Kalman filter
/// with each robot.
class GainTable : public QTreeWidget {
  Q_OBJECT

 public:
  enum Column { kName, kNominal, kBefore, kAfter, kLeft, kDrawn, kColumns };

  explicit GainTable(QWidget* parent = nullptr);
  void setTheme(const Theme& theme);
  void showReport(const diagnosis::Report& report);

 private:
  void fill();
  QTreeWidgetItem* addGroup(const QString& words, const QString& tip);
  void addChannel(QTreeWidgetItem* group, const diagnosis::ChannelReport& channel, const QString& title);
  void addAxis(QTreeWidgetItem* group, const std::string& unit);
  void addFilter(QTreeWidgetItem* group, const diagnosis::FilterGain& gain);
  QTreeWidgetItem* addRow(QTreeWidgetItem* group, const QStringList& cells);
  /// End of the axis of this unit, in the unit for people.
  double reachOf(const std::string& unit) const;

  Theme theme_ = Theme::dark();
  std::vector<diagnosis::ChannelReport> channels_;  ///< the report's channels without samples and signatures
  std::vector<QString> titles_;                     ///< titles of channels_
  std::vector<diagnosis::FilterGain> filter_;
};

}  // namespace capstan::widgets
