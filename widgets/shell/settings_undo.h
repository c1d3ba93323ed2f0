#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <functional>

class QAction;
class QUndoStack;

namespace capstan::widgets {

/// Undo and redo (Ctrl+Z, Ctrl+Shift+Z) of changed settings of the window, each by its name. Who changes a
/// setting reports it here after the change.
class SettingsUndo : public QObject {
  Q_OBJECT

 public:
  static constexpr int kMost = 100;  ///< number of changes that can be undone; the oldest are forgotten

  explicit SettingsUndo(QObject* parent = nullptr);

  /// The setting `name` was changed; `before` and `after` set its former and its new value. A change of the
  /// same setting within a second of the last one is part of that one. Ignored during an undo or a redo.
  void changed(const QString& name, std::function<void()> before, std::function<void()> after);
  /// Forgets all changes: they were of another session.
  void clear();
  QAction* undoAction() const { return undo_; }
  QAction* redoAction() const { return redo_; }

 private:
  QUndoStack* stack_;
  QAction *undo_, *redo_;
  QElapsedTimer since_last_;
  bool applying_ = false;
};

}  // namespace capstan::widgets
