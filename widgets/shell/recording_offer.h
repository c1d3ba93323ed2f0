#pragma once

#include <QObject>

namespace capstan::live {
struct RunStatus;
}

namespace capstan::widgets {

class MessageBar;
class SessionLink;

/// When a recording is complete, offers to open it or to analyse its errors, in a bar that covers nothing.
class RecordingOffer : public QObject {
  Q_OBJECT

 public:
  RecordingOffer(MessageBar& news, const SessionLink& link, QObject* parent);

 signals:
  void openRequested(const QString& file);
  void analyseRequested(const QString& file);
  /// A recording is complete.
  void recorded(const QString& file);

 private:
  void showStatus(const live::RunStatus& status);
  void offer(const QString& file);

  MessageBar& news_;
  QString file_;  ///< the recording under way; empty: none
};

}  // namespace capstan::widgets
