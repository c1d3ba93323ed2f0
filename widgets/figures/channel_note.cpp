#include "widgets/figures/channel_note.h"

#include <QStringList>

#include "core/diagnosis/report/report_tables.h"

namespace capstan::widgets {

QString explainedNote(const diagnosis::Report& report, const diagnosis::ChannelReport& channel) {
  return QString::fromStdString(diagnosis::explainedText(report, channel.refitted.name));
}

QString channelNote(const diagnosis::Report& report, const diagnosis::ChannelReport& channel) {
  QStringList parts;
  const auto recording = static_cast<std::size_t>(channel.recording);
  if (recording < report.recordings.size()) parts << QString::fromStdString(report.recordings[recording]);
  if (const QString explained = explainedNote(report, channel); !explained.isEmpty()) parts << explained;
  return parts.join(QStringLiteral(". "));
}

}  // namespace capstan::widgets
