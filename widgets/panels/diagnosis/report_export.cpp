#include "widgets/panels/diagnosis/report_export.h"

#include <QDateTime>
#include <QDir>

#include "core/base/error.h"
#include "core/base/software.h"

namespace capstan::widgets {

ReportExport::ReportExport(QObject* parent) : QObject(parent) {
  next_.setSingleShot(true);
  connect(&next_, &QTimer::timeout, this, &ReportExport::drawNext);
}

void ReportExport::start(const diagnosis::Report& report, const std::string& robot, const QString& folder) {
  Q_ASSERT(!busy());
  const DiagnosisOrigin origin{robot, base::software(),
                               QDateTime::currentDateTimeUtc().toString(Qt::ISODate).toStdString()};
  drawing_ = std::make_unique<DiagnosisExport>(report, origin, folder.toStdString());
  folder_ = folder;
  next_.start(0);
}

void ReportExport::drawNext() {
  if (!drawing_) return;
  try {
    if (drawing_->drawn()) {
      const auto files = drawing_->finish();
      return end(QString::fromStdString(files.back().string()),
                 tr("%1 files in %2.").arg(files.size()).arg(QDir::toNativeSeparators(folder_)));
    }
    Q_EMIT progressed(drawing_->fraction(), QString::fromStdString(drawing_->name()));
    drawing_->draw();
    next_.start(0);
  } catch (const base::InputError& error) {
    end({}, QString::fromStdString(error.what()));
  }
}

void ReportExport::cancel() {
  if (busy()) end({}, tr("Export cancelled; %1 is not complete.").arg(QDir::toNativeSeparators(folder_)));
}

void ReportExport::end(const QString& index, const QString& words) {
  next_.stop();
  drawing_.reset();
  Q_EMIT ended(index, words);
}

}  // namespace capstan::widgets
