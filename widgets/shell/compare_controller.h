#pragma once

#include <QObject>
#include <memory>

#include "core/analysis/rerun.h"
#include "widgets/figures/theme.h"
#include "widgets/jobs/job.h"
#include "widgets/shell/second_run.h"
#include "widgets/shell/source_choice.h"

class QAction;
class QSplitter;

namespace capstan::widgets {

class JointFigure;
class LinkedFigures;
class MessageBar;
class NotesPanel;
class SessionLink;

/// A second run beside the session: the session itself tracked again with something changed, drawn over the
/// plots, or another recording beside them, with the time aligned by the motion and linked.
class CompareController : public QObject {
  Q_OBJECT

 public:
  struct Views {
    QSplitter& plots;  ///< holds the figure, and the second one beside it
    JointFigure& figure;
    MessageBar& news;
  };
  CompareController(const Views& views, SessionLink& link, QObject* parent);
  ~CompareController() override;

  void setTheme(const Theme& theme);
  void rerun(const analysis::RerunChange& change);
  void compareWith(const QString& file);
  /// Takes the second run away.
  void end();
  bool busy() const { return job_.busy(); }
  const SecondRun* second() const { return second_.get(); }
  JointFigure* secondFigure() const { return second_figure_; }

 private:
  QAction* addAction(const char* name, const QString& text, const QString& key);
  void askRerun();
  void askFile();
  void start(std::function<std::shared_ptr<SecondRun>(base::Progress&)> work, std::function<void()> show);
  void showOver();
  void showBeside();
  void say(const QString& words);

  Theme theme_ = Theme::dark();
  Views views_;
  SessionLink& link_;
  QAction *rerun_, *compare_, *end_;
  SourceChoice choice_;  ///< of the session
  analysis::MotionSeries motion_;
  std::shared_ptr<SecondRun> second_;
  JointFigure* second_figure_ = nullptr;
  std::unique_ptr<LinkedFigures> linked_;
  Job job_;
};

}  // namespace capstan::widgets
