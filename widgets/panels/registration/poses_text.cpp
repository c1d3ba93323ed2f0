#include "widgets/panels/registration/poses_text.h"

#include <QObject>
#include <QStringList>
#include <algorithm>

#include "core/base/units.h"
#include "core/registration/closure.h"
#include "core/tracking/transmission_text.h"

namespace capstan::widgets {

using registration::PoseCollector;

QString inMillimetres(double metres, int digits) {
  return QString::number(base::toMillimetres(metres), 'f', digits).replace('-', QStringLiteral("−"));
}

QString wrongConstantsOf(const tracking::TransmissionEstimate& found) {
  bool wrong = false;
  for (const int joint : {0, 1, 2}) wrong |= found.includesScale(joint) || found.includesOffset(joint);
  return wrong ? QObject::tr(
                     "The filter finds the robot file wrong (%1), and the poses are computed with that "
                     "file. Identify the robot and accept the values before you accept this "
                     "registration; the poses are then computed again.")
                     .arg(QString::fromStdString(tracking::shortTextOf(found)))
               : QString();
}

QString fitText(const PoseCollector& collector, const std::optional<Eigen::Isometry3d>& current) {
  const auto& fit = *collector.fit();
  const auto line = [](const QString& name, const QString& value) { return name.leftJustified(24) + value; };
  const Eigen::Vector3d place = fit.base_from_camera.translation();
  QStringList lines = {
      line(QObject::tr("base_from_camera"),
           QString("%1, %2, %3 mm")
               .arg(inMillimetres(place.x()), inMillimetres(place.y()), inMillimetres(place.z())))};
  if (current) {
    const Eigen::AngleAxisd turn(fit.base_from_camera.rotation() * current->rotation().transpose());
    double moved = 0.0;
    for (const auto& pose : collector.poses())
      moved = std::max(
          moved,
          ((fit.base_from_camera.inverse() * pose.pair.base) - (current->inverse() * pose.pair.base)).norm());
    lines << line(QObject::tr("from the one in use"),
                  QObject::tr("turned %1°, tip moved up to %2 mm")
                      .arg(base::toDegrees(std::abs(turn.angle())), 0, 'f', 2)
                      .arg(inMillimetres(moved)));
  }
  lines << line(
      QObject::tr("residual, leave-one-out"),
      QObject::tr("%1 mm, %2 mm RMS").arg(inMillimetres(fit.rms), inMillimetres(fit.leave_one_out_rms)));
  const auto error = collector.workspaceError();
  lines << line(QObject::tr("95 % error, workspace"),
                QObject::tr("%1 mm, %2 mm at its far end")
                    .arg(inMillimetres(error.median), inMillimetres(error.largest)));
  return lines.join('\n');
}

QString closureText(const PoseCollector& collector, const std::optional<Eigen::Isometry3d>& current) {
  const auto& checks = collector.checks();
  if (collector.checking())
    return QObject::tr("Move the arm: %1 of %2 poses").arg(checks.size()).arg(PoseCollector::kChecks);
  if (!collector.fit() && !current)
    return QObject::tr("No registration is in use, and there is no fit yet: nothing to check");
  if (checks.empty())
    return QObject::tr("Compares the %1 with three poses that are not in it")
        .arg(collector.fit() ? QObject::tr("fit") : QObject::tr("registration in use"));
  const auto closures = collector.fit() ? registration::closuresOf(*collector.fit(), checks)
                                        : registration::closuresOf(*current, checks);
  QStringList errors;
  for (const auto& closure : closures) errors << inMillimetres(closure.error);
  return QObject::tr("%1 mm. %2.")
      .arg(errors.join(", "), QString::fromStdString(registration::closureWords(closures)));
}

}  // namespace capstan::widgets
