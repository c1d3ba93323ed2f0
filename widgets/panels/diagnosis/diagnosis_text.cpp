#include "widgets/panels/diagnosis/diagnosis_text.h"

#include <QObject>
#include <algorithm>
#include <cmath>

#include "core/diagnosis/report/report_tables.h"
#include "core/diagnosis/report/shown.h"
#include "widgets/figures/number_text.h"

namespace capstan::widgets {

namespace {

using diagnosis::Verdict;

QString text(std::string_view words) {
  return QString::fromUtf8(words.data(), static_cast<int>(words.size()));
}

QString jointName(const robot::Description& robot, int joint) {
  const bool known = joint > 0 && joint <= robot.size();
  return known ? text(robot.joints[static_cast<std::size_t>(joint - 1)].name) : QString();
}

/// A title in lower case for use within a sentence; abbreviations and names keep their case.
QString within(QString title) {
  if (title.size() > 1 && title[1].isLower()) title[0] = title[0].toLower();
  return title;
}

QStringList namesOf(const std::vector<diagnosis::Cause>& causes, const robot::Description& robot) {
  QStringList names;
  for (const diagnosis::Cause& cause : causes)
    names << within(titleOf(cause.effect)) + placeAfterTitle(cause.effect, cause.joint, robot);
  return names;
}

/// The causes, those of a tie together: "payload, arm — or inertia, joint 2".
QStringList withTies(const diagnosis::Report& report) {
  QStringList names = namesOf(report.causes, report.extended);
  for (std::size_t k = 0; k < report.causes.size(); ++k)
    if (const diagnosis::Tie* tie = diagnosis::tieOfCause(report, report.causes[k]))
      names[static_cast<int>(k)] = tiedNames(*tie, report.extended).join(QObject::tr(" — or "));
  return names;
}

}  // namespace

QString titleOf(const std::string& effect) { return text(diagnosis::titleOf(effect)); }

QString placeOf(const std::string& effect, int joint, const robot::Description& robot) {
  const QString name = jointName(robot, joint), place = text(diagnosis::shownJoint(effect, joint));
  return name.isEmpty() ? place : QStringLiteral("%1 (%2)").arg(place, name);
}

QString placeAfterTitle(const std::string& effect, int joint, const robot::Description& robot) {
  return diagnosis::namesItsPlace(effect) ? QString() : QStringLiteral(", ") + placeOf(effect, joint, robot);
}

QStringList tiedNames(const diagnosis::Tie& tie, const robot::Description& robot) {
  return namesOf(diagnosis::mostProbableFirst(tie), robot);
}

QString headlineOf(const diagnosis::Report& report) {
  const QStringList causes = namesOf(report.causes, report.extended);
  switch (report.verdict) {
    case Verdict::kFound:
      return QObject::tr("Found: %1").arg(causes.join(QString()));
    case Verdict::kSeveral:
      return QObject::tr("Several causes: %1").arg(withTies(report).join(QStringLiteral("; ")));
    case Verdict::kTie: {
      QStringList names = withTies(report);
      const QString tied = QObject::tr("Cannot be distinguished: %1").arg(names.takeFirst());
      return names.isEmpty()
                 ? tied
                 : QObject::tr("%1; there as well: %2").arg(tied, names.join(QStringLiteral("; ")));
    }
    case Verdict::kUnexplained:
      return causes.isEmpty() ? QObject::tr("Something is there that no hypothesis explains")
                              : QObject::tr("%1; and something that no hypothesis explains")
                                    .arg(causes.join(QStringLiteral("; ")));
    case Verdict::kNothing:
      break;
  }
  if (report.also_measurable.empty()) return QObject::tr("Nothing material");
  return QObject::tr("Nothing above the tolerance; measurable: %1")
      .arg(namesOf(report.also_measurable, report.extended).join(QStringLiteral("; ")));
}

QString channelTitle(const diagnosis::Report& report, const diagnosis::ChannelReport& channel) {
  QString title = text(channel.refitted.name);
  const QString name = jointName(report.refitted, channel.refitted.joint);
  if (!name.isEmpty()) title += QStringLiteral(" (%1)").arg(name);
  const auto recording = static_cast<std::size_t>(channel.recording);
  if (report.recordings.size() < 2 || recording >= report.recordings.size()) return title;
  return text(report.recordings[recording]) + QStringLiteral(" · ") + title;
}

std::string channelWorthSeeing(const diagnosis::Report& report) {
  if (!report.processes.empty()) return report.processes.front().channel;
  if (!report.lines.empty()) return report.lines.front().channel;
  std::string worth;
  double most = -1.0;
  for (const diagnosis::ChannelReport& channel : report.channels) {
    const double share = channel.before.empty() ? 0.0 : std::max(channel.before.front().share, 0.0);
    const double explained = share * channel.refitted_statistics.beyond_noise;
    if (explained > most) most = explained, worth = channel.refitted.name;
  }
  return worth;
}

QString percentText(double share, int decimals, bool sign) {
  if (!std::isfinite(share)) return QStringLiteral("—");
  QString number = withMinus(QString::number(100.0 * share, 'f', decimals));
  if (sign && share > 0.0) number.prepend(QLatin1Char('+'));
  return number + QStringLiteral(" %");
}

}  // namespace capstan::widgets
