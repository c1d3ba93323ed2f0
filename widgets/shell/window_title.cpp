#include "widgets/shell/window_title.h"

#include <QFileInfo>

#include "core/live/runner.h"
#include "widgets/panels/status/status_line.h"

namespace capstan::widgets {

QString titleOfWindow(const QString& source, const live::RunStatus& status, double recorded) {
  QString title = QObject::tr("Capstan ─ %1").arg(source);
  if (recorded >= 0.0)
    title +=
        QStringLiteral(" ─ %1 ● REC %2")
            .arg(QFileInfo(QString::fromStdString(status.recording)).completeBaseName(), clockText(recorded));
  return title;
}

}  // namespace capstan::widgets
