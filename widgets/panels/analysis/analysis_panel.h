#pragma once

#include <QWidget>
#include <array>
#include <functional>
#include <memory>

#include "core/analysis/analysis.h"
#include "widgets/figures/paper_size.h"
#include "widgets/figures/theme.h"
#include "widgets/jobs/job.h"
#include "widgets/panels/analysis/analysis_figures.h"
#include "widgets/panels/analysis/full_export.h"
#include "widgets/panels/analysis/run_picker.h"

class QBoxLayout;
class QLabel;
class QProgressBar;
class QPushButton;
class QSettings;
class QSplitter;
class QToolButton;

namespace capstan::widgets {

class AnalysisTable;
class FigurePair;
class OptionsBar;

/// Errors of up to two runs as histogram, box plot and numbers. A run is the running session so far, a
/// recording, or a trial of an experiment. Reading, tracking and statistics run in the background, one job at
/// a time, and only while the panel is visible: numbers and figures first, then the intervals of differences.
class AnalysisPanel : public QWidget {
  Q_OBJECT

 public:
  explicit AnalysisPanel(QWidget* parent = nullptr);
  ~AnalysisPanel() override;

  void setTheme(const Theme& theme);
  /// Sets the function that returns the errors of the running session so far. It throws base::InputError
  /// where there are none.
  void setSession(std::function<analysis::ErrorRun()> session);
  /// Another session was opened: discards the errors of the former one.
  void sessionOpened();
  void setJointNames(const std::array<QString, 3>& names);
  void save(QSettings& settings) const;
  void restore(const QSettings& settings);

  /// Chooses run 0 (A) or 1 (B).
  void choose(std::size_t run, const RunChoice& choice);
  /// Reads the runs again; also continues after a cancel.
  void refresh();
  void cancel();
  /// Writes base-histogram and base-boxplot as .pdf, .svg, .png and .csv, base-table as .md, .tex and .csv.
  /// If writing fails, the panel shows the message.
  void exportTo(const QString& base, PaperSize size);
  /// Writes every figure and table of the chosen runs (for results: of the whole experiment) into `folder`,
  /// with an index page; for two runs also their comparison as shown. It runs in the background; the panel
  /// shows the result or the error.
  void exportAllTo(const QString& folder, PaperSize size = {});

  RunPicker& picker(std::size_t run) { return *sides_[run].picker; }
  OptionsBar& options() { return *options_; }
  AnalysisTable& table() { return *table_; }
  FigurePair& figures() { return *figures_; }
  const analysis::Analysis& analysis() const { return analysis_; }
  QString words() const;
  bool busy() const { return job_.busy() || full_export_.busy(); }
  /// Whether all work for the present choice is done.
  bool settled() const;

 signals:
  void exported(const QString& base);

 protected:
  void showEvent(QShowEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  enum class Work { kNothing, kLoadingA, kLoadingB, kAnalysing, kIntervals };
  struct Side {
    RunPicker* picker = nullptr;
    std::shared_ptr<const analysis::ErrorRun> run;
    bool stale = true;  ///< `run` is not yet the chosen run
    QString fault;      ///< error why there is no run; empty: none
  };
  struct Prepared {
    analysis::Analysis analysis;
    AnalysisFigures figures;
  };

  void addHead(QBoxLayout* column);
  void addFoot(QBoxLayout* column);
  void onRunChanged(std::size_t run);
  void onOptionsChanged();
  void proceed();
  bool load(std::size_t run);
  void took(std::size_t run, analysis::ErrorRun loaded);
  void prepare();
  void addIntervals();
  void onFailed(const QString& why);
  void say();
  void askExport(const PaperSize& size);
  void askExportAll();
  void onProgress(double fraction, const QString& doing);
  std::vector<ExportedRun> exportedRuns() const;
  ExportExtras comparison() const;

  std::function<analysis::ErrorRun()> session_;
  std::array<QString, 3> joint_names_;
  std::array<Side, 2> sides_;
  analysis::Analysis analysis_;
  bool analysis_stale_ = true, intervals_stale_ = true, halted_ = false;
  QString fault_, said_;
  Work work_ = Work::kNothing;
  OptionsBar* options_;
  QSplitter* split_;
  bool user_split_ = false;  ///< the user has moved the splitter: it is not arranged again
  FigurePair* figures_;
  AnalysisTable* table_;
  QLabel* words_;
  QProgressBar* progress_;
  QToolButton *refresh_, *export_all_;
  QPushButton* cancel_;
  FullExport full_export_;
  Job job_;  ///< last member: destroyed before the members it reports to
};

}  // namespace capstan::widgets
