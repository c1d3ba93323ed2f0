#pragma once

#include <QObject>
#include <array>

#include "core/analysis/session_record.h"
#include "widgets/figures/theme.h"
#include "widgets/panels/analysis/full_export.h"
#include "widgets/shell/source_choice.h"

namespace capstan::widgets {

class AnalysisController;
class JointFigure;
class MessageBar;
class NotesPanel;
class SessionBar;
class SessionLink;

/// Exports of the open session: its joint plots in the chosen range of time, or everything about it in one
/// folder with an index page, as `capstan-cli export` writes it of a recording. A bar shows the progress, a
/// button to cancel, and what was written.
class ExportController : public QObject {
  Q_OBJECT

 public:
  struct Views {
    JointFigure& figure;
    NotesPanel& notes;
    MessageBar &faults, &news;
  };

  ExportController(const Views& views, const AnalysisController& errors, SessionLink& link, SessionBar& bar,
                   QObject* parent);

  /// Writes the joint plots in their present state: base.pdf, .svg, .png and .csv.
  void exportPlots(const QString& base);
  /// Writes everything into `folder`. It is drawn part by part while the window goes on.
  void exportEverything(const QString& folder);
  bool busy() const { return everything_.busy(); }

 private:
  void askPlots();
  void askEverything();
  void gather(const tracking::SourceInfo& info, const SourceChoice& choice);
  analysis::SessionRecord record() const;
  void showProgress(double fraction, const QString& doing);
  void showEnd(const QString& index, const QString& words);
  void fail(const std::exception& error);

  Views views_;
  const AnalysisController& errors_;
  SessionLink& link_;
  std::array<QString, 3> joint_names_;
  std::string title_;  ///< of the source in the window: of a recording its file name, too
  std::vector<recording::SessionEvent> events_;
  double now_ = 0.0;  ///< newest session time [s]
  FullExport everything_;
};

}  // namespace capstan::widgets
