#pragma once

#include <QObject>

namespace capstan::tracking {
struct SourceInfo;
}

namespace capstan::widgets {

class NotesPanel;
class SessionLink;
class StatusLine;

/// Names the robot in use in the status line, and in the notes where a session begins with one that was
/// chosen before. Made after what clears the notes for a new session.
class RobotController : public QObject {
  Q_OBJECT

 public:
  RobotController(SessionLink& link, StatusLine& status, NotesPanel& notes, QObject* parent);

 private:
  void show(const tracking::SourceInfo& info);
  void report(const tracking::SourceInfo& info);

  SessionLink& link_;
  StatusLine& status_;
  NotesPanel& notes_;
};

}  // namespace capstan::widgets
