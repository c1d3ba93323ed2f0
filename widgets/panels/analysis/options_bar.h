#pragma once

#include <QAction>
#include <QWidget>
#include <array>

#include "core/analysis/analysis.h"
#include "widgets/figures/paper_size.h"
#include "widgets/figures/theme.h"

class QCheckBox;
class QComboBox;
class QSettings;
class QToolButton;

namespace capstan::widgets {

/// Chooses the part of the runs that is analysed (joint, estimators, error or |error|, time), and the export.
class OptionsBar : public QWidget {
  Q_OBJECT

 public:
  explicit OptionsBar(QWidget* parent = nullptr);

  void setTheme(const Theme& theme);
  analysis::AnalysisOptions options() const;
  void setJoint(std::optional<int> joint);
  void save(QSettings& settings) const;
  void restore(const QSettings& settings);
  void setExportEnabled(bool on);
  /// Whether exported figures have their titles above them.
  bool titles() const { return titles_->isChecked(); }

 signals:
  void changed();
  void exportRequested(const capstan::widgets::PaperSize& size);

 private:
  void addChoices();
  void addEstimators();
  void addExport();
  void addKeys();

  QComboBox *joint_, *error_, *share_;
  std::array<QCheckBox*, 3> estimators_{};
  QToolButton* export_;
  QAction* titles_;
};

}  // namespace capstan::widgets
