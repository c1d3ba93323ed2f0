#pragma once

#include <QMenu>

#include "widgets/shell/source_choice.h"

namespace capstan::widgets {

class SimulationDialog;

/// New simulation, open a file, and the recordings opened lately.
class SourceMenu : public QMenu {
  Q_OBJECT

 public:
  static constexpr int kMostRecent = 8;

  explicit SourceMenu(QWidget* parent = nullptr);

  /// Remembers what was opened: the dialog starts from it, files come first in the list.
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
  QMenu* recent_menu_;
  QStringList recent_;
};

}  // namespace capstan::widgets
