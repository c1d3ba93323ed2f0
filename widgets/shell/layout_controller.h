#pragma once

#include <QMenu>
#include <functional>

class QMainWindow;
class QSettings;

namespace capstan::widgets {

class SettingsUndo;

/// Arrangements of the window's docks: the one of the last time, and those that the user has named. Menu to
/// choose, save, delete and reset them. Choosing, resetting, and closing a dock can be undone.
class LayoutController : public QMenu {
  Q_OBJECT

 public:
  /// Create it when all docks exist, before any layout is restored.
  LayoutController(QMainWindow& window, QSettings& settings, SettingsUndo& undo);

  /// Arranges the docks as they were at the end of the last time. False: there was none.
  bool restoreLast();
  void saveLast();

  QStringList names() const;
  /// Stores the present layout under `name`; an earlier one of this name is replaced.
  void store(const QString& name);
  void choose(const QString& name);
  void remove(const QString& name);
  /// Arranges the docks as in a new installation.
  void reset();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void fill();
  void askName();
  void arrange(const QString& what, const std::function<void()>& act);

  QMainWindow& window_;
  QSettings& settings_;
  SettingsUndo& undo_;
  QByteArray first_;  ///< state before any layout was restored
  QMenu* delete_;
  QAction *save_, *reset_;
};

}  // namespace capstan::widgets
