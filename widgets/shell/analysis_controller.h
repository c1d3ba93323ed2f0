#pragma once

#include <QObject>
#include <filesystem>
#include <memory>
#include <vector>

#include "core/analysis/error_run.h"
#include "core/experiments/motion_collector.h"

class QStackedWidget;

namespace capstan::widgets {

class AnalysisPanel;
class ErrorsPanel;
class NotesPanel;
class SessionBar;
class SessionLink;

/// Joins the analysis panel to the running session: gathers its errors and its motion since the errors table
/// began, brings the panel in the place of the plots and back, a line in the notes for what was exported.
class AnalysisController : public QObject {
  Q_OBJECT

 public:
  /// `centre`: the plots first, the panel behind them.
  AnalysisController(AnalysisPanel& panel, QStackedWidget& centre, SessionLink& link, SessionBar& bar,
                     ErrorsPanel& errors, NotesPanel& notes, QObject* parent);

 private:
  void addAction(QStackedWidget& centre, SessionBar& bar);
  void gather(SessionLink& link);
  analysis::ErrorRun sessionSoFar(const SessionLink& link) const;
  /// Files that hold the session: what it replays, and what it has recorded.
  void noteFile(const QString& file);

  AnalysisPanel& panel_;
  /// What is gathered on the pipeline's thread.
  struct Gathered {
    analysis::ErrorCollector errors;
    experiments::SessionMotion motion;
    void restart() {
      errors.restart();
      motion.restart();
    }
  };
  std::shared_ptr<Gathered> gathered_ = std::make_shared<Gathered>();
  std::vector<std::filesystem::path> files_;
  double now_ = 0.0;  ///< newest session time [s]
};

}  // namespace capstan::widgets
