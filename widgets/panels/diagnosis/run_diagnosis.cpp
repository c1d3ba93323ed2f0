#include "core/base/error.h"
#include "core/base/resource.h"
#include "core/base/same_recording.h"
#include "core/diagnosis/diagnose.h"
#include "core/diagnosis/evidence/read_evidence.h"
#include "core/robot/description.h"
#include "widgets/panels/diagnosis/diagnosis_choice.h"

namespace capstan::widgets {

namespace {

constexpr double kReadingShare = 0.1;  ///< of the progress bar

/// The robot that recordings bring, or `otherwise` where none does.
robot::Description nominalOf(const std::vector<diagnosis::Evidence>& recordings,
                             const robot::Description& otherwise) {
  const diagnosis::Evidence* first = nullptr;
  for (const diagnosis::Evidence& evidence : recordings) {
    if (!evidence.robot) continue;
    if (!first) first = &evidence;
    if (robot::formatDescription(*evidence.robot) != robot::formatDescription(*first->robot))
      throw base::InputError({evidence.file,
                              0,
                              {},
                              {},
                              "brings another robot than " + first->file,
                              "Choose the robot file that both are to be compared with"});
  }
  return first ? *first->robot : otherwise;
}

/// base::InputError: one that comes twice, under another path.
void checkRecordings(const QStringList& files) {
  for (int i = 0; i < files.size(); ++i)
    for (int j = 0; j < i; ++j)
      if (base::sameRecording(files[j].toStdString(), files[i].toStdString()))
        throw base::InputError(
            {files[i].toStdString(),
             0,
             {},
             {},
             "is the same recording as " + files[j].toStdString() + ": it would count twice",
             "Choose each recording once"});
}

}  // namespace

diagnosis::Report runDiagnosis(const DiagnosisChoice& choice, base::Progress& progress) {
  const robot::Description robot =
      robot::readDescription(choice.robot.isEmpty() ? base::resource("robots/raven2_left.yaml")
                                                    : std::filesystem::path(choice.robot.toStdString()));
  checkRecordings(choice.recordings);
  std::vector<diagnosis::Evidence> recordings;
  for (const QString& file : choice.recordings) {
    progress.report(
        kReadingShare * static_cast<double>(recordings.size()) / std::max(choice.recordings.size(), 1),
        "reading " + std::filesystem::path(file.toStdString()).filename().string());
    recordings.push_back(diagnosis::readEvidence(file.toStdString(), robot));
    if (progress.cancelled()) return {};
  }
  const robot::Description nominal = choice.robot.isEmpty() ? nominalOf(recordings, robot) : robot;
  return diagnosis::diagnose(recordings, nominal, {}, &progress);
}

}  // namespace capstan::widgets
