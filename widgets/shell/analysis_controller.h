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

/// Connects the analysis panel to the running session: gathers errors and motion of the session since the
/// errors table was reset, switches between the plots and the panel, and adds a note for each export.
class AnalysisController : public QObject {
  Q_OBJECT

 public:
  /// `centre`: contains the plots first, then the panel.
  AnalysisController(AnalysisPanel& panel, QStackedWidget& centre, SessionLink& link, SessionBar& bar,
                     ErrorsPanel& errors, NotesPanel& notes, QObject* parent);

  /// Errors and motion of the session since its error table began; without errors where it has no reference.
  /// Throws base::InputError without a session.
  analysis::ErrorRun soFar() const;

 private:
  void addAction(QStackedWidget& centre, SessionBar& bar);
  void gather();
  analysis::ErrorRun withErrors() const;
  /// Registers a file that contains the session: a file that it replays, or one that it has recorded.
  void noteFile(const QString& file);

  AnalysisPanel& panel_;
  SessionLink& link_;
  /// Data gathered on the pipeline's thread.
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
