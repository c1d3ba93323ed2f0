#pragma once

#include <QMenu>

#include "widgets/shell/source_choice.h"

namespace capstan::widgets {

class LiveDialog;
class SimulationDialog;

/// Menu with new simulation, open a file, connect to a live robot, and the recent recordings.
class SourceMenu : public QMenu {
  Q_OBJECT

 public:
  static constexpr int kMostRecent = 8;

  explicit SourceMenu(QWidget* parent = nullptr);

  /// Remembers the opened source: the dialog starts with it, a file becomes the first in the list.
  void remember(const SourceChoice& choice);
  QStringList recentFiles() const { return recent_; }
  void setRecentFiles(const QStringList& files);
  SimulationDialog& dialog() { return *dialog_; }

 signals:
  void chosen(const capstan::widgets::SourceChoice& choice);

 private:
  void askFile();
  void fillRecent();

  SimulationDialog* dialog_;
  LiveDialog* live_;
  QMenu* recent_menu_;
  QStringList recent_;
};

}  // namespace capstan::widgets
