#pragma once

#include <QMenu>

#include "widgets/shell/source_choice.h"

namespace capstan::widgets {

class LiveDialog;
class RecentMenu;
class SimulationDialog;

/// Menu with new simulation, open a file, connect to a live robot, and the recent recordings.
class SourceMenu : public QMenu {
  Q_OBJECT

 public:
  explicit SourceMenu(QWidget* parent = nullptr);

  /// Remembers the opened source: the dialog starts with it, a file becomes the first in the list.
  void remember(const SourceChoice& choice);
  RecentMenu& recent() { return *recent_; }
  SimulationDialog& dialog() { return *dialog_; }

 signals:
  void recoverRequested();
  void chosen(const capstan::widgets::SourceChoice& choice);

 private:
  void askFile();

  SimulationDialog* dialog_;
  LiveDialog* live_;
  RecentMenu* recent_;
};

}  // namespace capstan::widgets
