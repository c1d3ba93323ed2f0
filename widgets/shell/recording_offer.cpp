#include "widgets/shell/recording_offer.h"

#include <QFileInfo>

#include "widgets/shell/message_bar.h"
#include "widgets/shell/session_link.h"

namespace capstan::widgets {

using recording::RecorderState;

RecordingOffer::RecordingOffer(MessageBar& news, const SessionLink& link, QObject* parent)
    : QObject(parent), news_(news) {
  connect(&link, &SessionLink::status, this, &RecordingOffer::showStatus);
  connect(&link, &SessionLink::opened, this, [this] {
    if (!file_.isEmpty()) Q_EMIT recorded(file_);  // it ended with its session
    file_.clear();
    news_.hide();
  });
}

void RecordingOffer::showStatus(const live::RunStatus& status) {
  if (!status.recorder) return;
  const QString file = QString::fromStdString(status.recording);
  if (status.recorder->state == RecorderState::kRecording) {
    if (file_ != file) news_.hide();
    file_ = file;
  } else if (file_ == file) {
    file_.clear();
    if (status.recorder->state == RecorderState::kClosed) offer(file);
  }
}

void RecordingOffer::offer(const QString& file) {
  news_.showNews(tr("Recorded: %1").arg(QFileInfo(file).fileName()),
                 {{tr("Open"), [this, file] { Q_EMIT openRequested(file); }},
                  {tr("Analyse"), [this, file] { Q_EMIT analyseRequested(file); }}});
  Q_EMIT recorded(file);
}

}  // namespace capstan::widgets
