#include "widgets/jobs/step_export.h"

#include <QDir>
#include <exception>

namespace capstan::widgets {

StepExport::StepExport(QObject* parent) : QObject(parent) {
  connect(&timer_, &QTimer::timeout, this, [this] { attempt([this] { step(); }); });
}

void StepExport::attempt(const std::function<void()>& part) {
  try {
    part();
  } catch (const std::exception& error) {
    end({}, QString::fromStdString(error.what()));
  }
}

void StepExport::end(const QString& result, const QString& words) {
  timer_.stop();
  drop();
  Q_EMIT ended(result, words);
}

void StepExport::endCancelled(const QString& folder) {
  if (busy()) end({}, tr("Export cancelled; %1 is not complete.").arg(QDir::toNativeSeparators(folder)));
}

}  // namespace capstan::widgets
