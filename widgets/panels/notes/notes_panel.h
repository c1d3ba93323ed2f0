#pragma once

#include <QTimer>
#include <QWidget>

#include "widgets/figures/theme.h"

class QLineEdit;
class QTreeWidget;
class QTreeWidgetItem;

namespace capstan::widgets {

/// Events of a session and notes of its user, newest last, and a line to write a note.
class NotesPanel : public QWidget {
  Q_OBJECT

 public:
  static constexpr int kMostRows = 2000;  ///< limit; the oldest rows are removed

  explicit NotesPanel(QWidget* parent = nullptr);

  void setTheme(const Theme& theme);
  void clear();
  /// Adds a row: session time [s], kind ("note", "recording", "occlusion", "fault", …) and text.
  void addEvent(double t, const QString& kind, const QString& text);
  /// Adds a row about a file: its name, shortened in the middle where it does not fit, and its path as tool
  /// tip.
  void addFile(double t, const QString& kind, const QString& path);
  /// Sets whether a recording is running. Notes are saved only while recording; the line says which it is.
  void setRecording(bool recording);
  /// Moves the keyboard focus to the line; Escape moves it back.
  void beginNote();

  int rows() const;
  /// Text of one row: "time kind text".
  QString row(int index) const;
  QLineEdit& line() { return *line_; }

 signals:
  void noteWritten(const QString& text);
  /// A row was added.
  void eventAdded(double t, const QString& kind, const QString& text);
  /// The user wants to see this time [s].
  void timeChosen(double t);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void paintRow(QTreeWidgetItem* item) const;
  void nameFile(QTreeWidgetItem* item) const;

  Theme theme_ = Theme::dark();
  QTreeWidget* list_;
  QLineEdit* line_;
  QTimer naming_;  ///< shortens names of files again when the columns have their widths
  QTimer scroll_;  ///< scrolls to the newest row, once for all rows added together
};

}  // namespace capstan::widgets
