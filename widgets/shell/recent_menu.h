#pragma once

#include <QMenu>
#include <QStringList>
#include <map>

#include "widgets/jobs/job.h"

namespace capstan::widgets {

/// The recordings that were opened last, newest first, each with its first image, date, duration and robot.
/// Files that are gone are shown, but cannot be chosen. They are read in the background when the menu is
/// opened, and kept in the user's cache folder until their file changes or leaves the list.
class RecentMenu : public QMenu {
  Q_OBJECT

 public:
  static constexpr int kMost = 8;

  explicit RecentMenu(QWidget* parent = nullptr);

  QStringList files() const { return files_; }
  void setFiles(const QStringList& files);
  /// Puts a file at the head of the list.
  void remember(const QString& file);
  /// Details of the list's file `index`, as the menu shows them: "2026-11-20 14:12 · 3:12 · RAVEN-II left".
  QString details(int index) const;
  bool reading() const { return job_.busy(); }

 signals:
  void chosen(const QString& file);

 private:
  void refresh();
  void readMissing();

  QStringList files_;
  Job job_;
};

}  // namespace capstan::widgets
