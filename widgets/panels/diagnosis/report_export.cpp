#include "widgets/panels/diagnosis/report_export.h"

#include <QDateTime>
#include <QDir>

#include "core/base/software.h"

namespace capstan::widgets {

void ReportExport::start(const diagnosis::Report& report, const std::string& robot, const QString& folder) {
  Q_ASSERT(!busy());
  const DiagnosisOrigin origin{robot, base::software(),
                               QDateTime::currentDateTimeUtc().toString(Qt::ISODate).toStdString()};
  drawing_ = std::make_unique<DiagnosisExport>(report, origin, folder.toStdString());
  folder_ = folder;
  begin();
}

void ReportExport::step() {
  if (drawing_->drawn()) {
    const auto files = drawing_->finish();
    return end(QString::fromStdString(files.back().string()),
               tr("%1 files in %2.").arg(files.size()).arg(QDir::toNativeSeparators(folder_)));
  }
  Q_EMIT progressed(drawing_->fraction(), QString::fromStdString(drawing_->name()));
  drawing_->draw();
}

}  // namespace capstan::widgets
