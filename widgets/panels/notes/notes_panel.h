#pragma once

#include <QTimer>
#include <QWidget>

#include "widgets/figures/theme.h"

class QLineEdit;
class QTreeWidget;
class QTreeWidgetItem;

namespace capstan::widgets {

/// What happened in a session and what its user noted, newest last, and a line to write the next note.
class NotesPanel : public QWidget {
  Q_OBJECT

 public:
  static constexpr int kMostRows = 2000;  ///< the oldest make room

  explicit NotesPanel(QWidget* parent = nullptr);

  void setTheme(const Theme& theme);
  void clear();
  /// A row: session time [s], kind ("note", "recording", "registration", "occlusion", "fault") and text.
  void addEvent(double t, const QString& kind, const QString& text);
  /// A row about a file: its name, shortened in the middle where it does not fit, and its path as tool tip.
  void addFile(double t, const QString& kind, const QString& path);
  /// Notes are kept in a file only while recording; the line says which.
  void setRecording(bool recording);
  /// Puts the keyboard into the line; Escape gives it back.
  void beginNote();

  int rows() const;
  /// One row as "time kind text".
  QString row(int index) const;
  QLineEdit& line() { return *line_; }

 signals:
  void noteWritten(const QString& text);
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
  QTimer naming_;  ///< of files again, once the columns have their widths
  QTimer scroll_;  ///< to the newest row, once however many came
};

}  // namespace capstan::widgets
