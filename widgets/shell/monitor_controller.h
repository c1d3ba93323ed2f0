#pragma once

#include <QObject>
#include <memory>

#include "core/live/monitor_feed.h"

namespace capstan::widgets {

class MessageBar;
class NotesPanel;
class SessionBar;
class SessionLink;

/// Feeds stereo monitors from the session, and starts them. There is no feed before the first monitor is
/// started; from then on every session of the window is fed.
class MonitorController : public QObject {
  Q_OBJECT

 public:
  MonitorController(SessionLink& link, SessionBar& bar, MessageBar& messages, NotesPanel& notes,
                    QObject* parent);

  /// Starts the feed `name`; empty: under the first free name. Nothing happens if it is running. Throws
  /// base::InputError.
  void startFeed(const QString& name);
  /// Name of the running feed; empty: none.
  QString feed() const;
  /// Program that the action starts; for tests.
  void setProgram(const QString& path) { program_ = path; }

 private:
  void startMonitor();
  void listen();

  SessionLink& link_;
  MessageBar& messages_;
  NotesPanel& notes_;
  QString program_;
  std::unique_ptr<live::MonitorFeed> feed_;
  double now_ = 0.0;  ///< newest session time [s]
};

}  // namespace capstan::widgets
