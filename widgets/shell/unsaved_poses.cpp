#include "widgets/shell/unsaved_poses.h"

#include <QCoreApplication>
#include <QDateTime>
#include <QDir>
#include <QMessageBox>
#include <QPushButton>
#include <QVariant>
#include <iostream>

#include "widgets/panels/registration/poses_page.h"

namespace capstan::widgets {

namespace {

void writeInto(const QString& folder, PosesPage& page) {
  const QString name = QDateTime::currentDateTime().toString("'unsaved-poses_'yyyy-MM-dd_HHmmss'.csv'");
  const QString file = QDir(folder).filePath(name);
  QDir().mkpath(folder);
  if (page.saveTo(file))
    std::cerr << "capstan: the unsaved poses of the registration are in " << file.toStdString() << '\n';
  else
    std::cerr << "capstan: " << file.toStdString() << " cannot be written: the poses are lost\n";
}

}  // namespace

bool settleUnsavedPoses(PosesPage& page, const QString& folder, QWidget* window) {
  if (!page.unsaved()) return true;
  if (QCoreApplication::instance()->property(kUnattended).toBool()) {
    writeInto(folder, page);
    return true;
  }
  const auto poses = page.collector()->poses().size();
  QMessageBox question(
      QMessageBox::Question, QObject::tr("Unsaved poses"),
      poses == 1 ? QObject::tr("One pose of a registration is neither accepted nor saved.")
                 : QObject::tr("%1 poses of a registration are neither accepted nor saved.").arg(poses),
      QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, window);
  question.setObjectName("unsavedPoses");
  question.setInformativeText(
      QObject::tr("See Register (Ctrl+R), Several poses. What is not saved is lost when the window closes."));
  question.button(QMessageBox::Save)->setText(QObject::tr("Save poses…"));
  question.button(QMessageBox::Discard)->setText(QObject::tr("Close without saving"));
  question.setDefaultButton(QMessageBox::Save);
  const int answer = question.exec();
  if (answer == QMessageBox::Save) return page.save();
  return answer == QMessageBox::Discard;
}

}  // namespace capstan::widgets
