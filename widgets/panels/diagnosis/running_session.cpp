#include "widgets/panels/diagnosis/running_session.h"

#include <QFileInfo>
#include <QObject>

namespace capstan::widgets {

namespace {

/// Why the session cannot use the robot; empty: it can.
QString refusal(const robot::Description& robot, const RunningSession& session) {
  if (session.joints == 0)
    return QObject::tr("No session is open: open a recording of this arm, simulate it, or connect to it.");
  const QString arm = QString::fromStdString(robot.name);
  if (robot.size() != session.joints)
    return QObject::tr("The diagnosed robot %1 has %2 joints, that of the open session %3.")
        .arg(arm)
        .arg(robot.size())
        .arg(session.joints);
  if (arm != session.arm)
    return QObject::tr("The diagnosed robot is %1, that of the open session is %2.").arg(arm, session.arm);
  return {};
}

/// File names for a button: the first one, and the number of the others.
QString shortNamesOf(const QStringList& paths) {
  const QString first = QFileInfo(paths.first()).fileName();
  return paths.size() < 2 ? first : QObject::tr("%1 and %2 more").arg(first).arg(paths.size() - 1);
}

}  // namespace

QString fileNamesOf(const QStringList& paths) {
  QStringList names;
  for (const QString& path : paths) names << QFileInfo(path).fileName();
  return names.join(QStringLiteral(", "));
}

UseOffer useOffer(const diagnosis::Report& report, const DiagnosisChoice& of, const RunningSession& session) {
  const bool own =
      of.recordings.isEmpty() || (!session.recording.isEmpty() &&
                                  of.recordings.contains(QFileInfo(session.recording).absoluteFilePath()));
  UseOffer offer;
  offer.words =
      own ? QObject::tr("Use this robot") : QObject::tr("Use robot of %1").arg(shortNamesOf(of.recordings));
  offer.tip = refusal(report.extended, session);
  offer.enabled = offer.tip.isEmpty();
  if (!offer.enabled) return offer;
  offer.tip = QObject::tr("The running session uses it from now on; errors restart (Ctrl+Shift+Return)");
  if (own) return offer;
  const QString open = session.recording.isEmpty() ? QObject::tr("a simulated or live %1").arg(session.arm)
                                                   : QFileInfo(session.recording).fileName();
  offer.tip += QObject::tr("\nDiagnosed: %1. Open: %2, the same arm by its name.")
                   .arg(fileNamesOf(of.recordings), open);
  return offer;
}

}  // namespace capstan::widgets
