#include "widgets/panels/identification/change_text.h"

#include <QObject>
#include <QStringList>

#include "core/identification/estimate_text.h"
#include "core/tracking/snapshot.h"
#include "widgets/figures/number_text.h"

namespace capstan::widgets {

QString changesText(const std::vector<identification::RobotChange>& changes) {
  QStringList lines;
  for (const auto& change : changes)
    lines << QString::fromStdString(change.name().empty() ? change.key : change.name() + "  " + change.key)
          << QStringLiteral("  %1 → %2  %3 %")
                 .arg(change.nominal, 0, 'g', 5)
                 .arg(change.identified, 0, 'g', 5)
                 .arg(signedText(change.percent, 2));
  return lines.isEmpty() ? QObject::tr("no difference") : lines.join('\n');
}

QString errorsText(const identification::ModelError& error, const robot::Description& robot) {
  QStringList lines = {
      QString("%1 %2 %3").arg(QObject::tr("camera − model"), -16).arg("before", 9).arg("after", 9)};
  for (int joint = 0; joint < 3; ++joint) {
    const auto& name = robot.joints[static_cast<std::size_t>(joint)].name;
    const auto number = [joint](double value) {
      return QString("%1 %2").arg(tracking::forPeople(value, joint), 0, 'f', 3).arg(joint < 2 ? "°" : "mm");
    };
    lines << QString("%1 %2 %3")
                 .arg(QString::fromStdString("q" + std::to_string(joint + 1) + " " + name).left(16), -16)
                 .arg(number(error.before(joint)), 9)
                 .arg(number(error.after(joint)), 9);
  }
  lines << QObject::tr("RMS over the same %1 camera samples").arg(error.observations);
  return lines.join('\n');
}

QString acceptTip(const std::vector<identification::Estimate>& estimates) {
  const QString found =
      estimates.empty() ? QString() : QString::fromStdString(identification::identifiedText(estimates));
  return QStringLiteral("<qt>%1 %2</qt>")
      .arg(QObject::tr("The filter uses the identified values from now on; errors restart (Ctrl+Return)."),
           found.toHtmlEscaped());
}

}  // namespace capstan::widgets
