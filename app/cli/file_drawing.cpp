#include "app/cli/file_drawing.h"

#include <QApplication>

#include "app/cli/console.h"

namespace capstan::cli {
namespace {

/// Prints messages of Qt as notices, except that on XDG_RUNTIME_DIR, which saved files do not need.
void passOn(QtMsgType, const QMessageLogContext&, const QString& message) {
  if (!message.startsWith(QLatin1String("QStandardPaths: XDG_RUNTIME_DIR"))) notice(message.toStdString());
}

}  // namespace

FileDrawing::FileDrawing() {
  qputenv("QT_QPA_PLATFORM", "offscreen");
  qInstallMessageHandler(passOn);
  application_ = std::make_unique<QApplication>(count_, arguments_);
}

FileDrawing::~FileDrawing() = default;

}  // namespace capstan::cli
