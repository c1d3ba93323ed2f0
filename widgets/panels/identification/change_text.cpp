#include "widgets/panels/identification/change_text.h"

#include <QObject>
#include <QStringList>
#include <cmath>

#include "core/identification/estimate_text.h"
#include "core/identification/live_text.h"
#include "core/tracking/snapshot.h"
#include "widgets/figures/number_text.h"

namespace capstan::widgets {

namespace {

/// "63.095 → 59.021 ±0.020 mm": σ where `estimates` has one, no unit where the change is of no parameter.
QString valuesText(const identification::RobotChange& change,
                   const std::vector<identification::Estimate>& estimates) {
  const auto parameter = change.parameter();
  const double scale = parameter ? identification::scaleOf(*parameter) : 1.0;
  const auto number = [scale](double value) { return QString::number(scale * value, 'g', 5); };
  QString after = number(change.identified);
  for (const identification::Estimate& estimate : estimates)
    if (parameter && parameter->nominal > 0.0 && estimate.seen &&
        estimate.parameter.name() == parameter->name()) {
      identification::Estimate shown = estimate;  // in the unit of the value before
      shown.log += std::log(estimate.parameter.nominal / parameter->nominal);
      shown.parameter.nominal = parameter->nominal;
      const auto row = identification::rowOf(shown, nullptr, change.percent);
      after = QString::fromStdString(row.value + " " + row.sigma);
    }
  const QString unit = parameter ? QString::fromStdString(identification::unitOf(*parameter)) : QString();
  return QStringLiteral("%1 → %2 %3").arg(number(change.nominal), after, unit).trimmed();
}

}  // namespace

QString changesText(const std::vector<identification::RobotChange>& changes,
                    const std::vector<identification::Estimate>& estimates) {
  QStringList lines;
  for (const auto& change : changes)
    lines << QString::fromStdString(change.name().empty() ? change.key : change.name() + "  " + change.key)
          << QStringLiteral("  %1, %2 %").arg(valuesText(change, estimates), signedText(change.percent, 2));
  return lines.isEmpty() ? QObject::tr("no difference") : lines.join('\n');
}

QString errorsText(const identification::ModelError& error, const robot::Description& robot) {
  const auto line = [](const QString& name, const QString& before, const QString& after) {
    return QString("%1 %2 %3").arg(name.left(12), -12).arg(before, 9).arg(after, 9);
  };
  QStringList lines = {
      QObject::tr("RMS of camera − model over the same %1 camera samples:").arg(error.observations),
      line(QObject::tr("joint"), QObject::tr("before"), QObject::tr("after"))};
  for (int joint = 0; joint < 3; ++joint) {
    const auto& name = robot.joints[static_cast<std::size_t>(joint)].name;
    const auto number = [joint](double value) {
      return QString("%1 %2").arg(tracking::forPeople(value, joint), 0, 'f', 3).arg(joint < 2 ? "°" : "mm");
    };
    lines << line(QString::fromStdString("q" + std::to_string(joint + 1) + " " + name),
                  number(error.before(joint)), number(error.after(joint)));
  }
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
