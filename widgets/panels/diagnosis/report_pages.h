#pragma once

#include <QTabWidget>
#include <memory>

#include "core/diagnosis/report/report.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

class GainTable;
class PosteriorTable;
class RankingTable;
class RefitTable;
class SignatureView;
class TimeView;

/// The pages of a report: signatures, time series, ranking, refit, gain, posterior; keys Alt+1 to Alt+6.
class ReportPages : public QTabWidget {
  Q_OBJECT

 public:
  explicit ReportPages(QWidget* parent = nullptr);

  void setTheme(const Theme& theme);
  void showReport(const std::shared_ptr<const diagnosis::Report>& report);
  /// Shows the figures of the channel `name`.
  void showChannel(const std::string& name);
  SignatureView& signatures() { return *signatures_; }
  TimeView& course() { return *history_; }
  RankingTable& ranking() { return *ranking_; }
  RefitTable& refit() { return *refit_; }
  GainTable& gain() { return *gain_; }
  PosteriorTable& posterior() { return *posterior_; }

 signals:
  /// A candidate of the ranking was selected.
  void candidateChosen();

 private:
  SignatureView* signatures_;
  TimeView* history_;
  RankingTable* ranking_;
  RefitTable* refit_;
  GainTable* gain_;
  PosteriorTable* posterior_;
};

}  // namespace capstan::widgets
