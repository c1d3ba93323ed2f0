#pragma once

#include <QObject>

namespace capstan::tracking {
struct SourceInfo;
}

namespace capstan::widgets {

class NotesPanel;
class OcclusionPanel;
class SessionLink;

/// Connects the occlusion panel and the session: blocks the cameras as the panel shows, and adds a note.
class OcclusionController : public QObject {
  Q_OBJECT

 public:
  OcclusionController(OcclusionPanel& panel, SessionLink& link, NotesPanel& notes, QObject* parent);

  /// A session was opened. Call this after its notes have begun.
  void begin(const tracking::SourceInfo& info);

 private:
  void take(bool blockable);
  void note(const QString& what);

  OcclusionPanel& panel_;
  SessionLink& link_;
  NotesPanel& notes_;
  double now_ = 0.0;  ///< newest session time [s]
};

}  // namespace capstan::widgets
