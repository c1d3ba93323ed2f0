#include "core/diagnosis/diagnose_files.h"

#include <filesystem>

#include "core/base/error.h"
#include "core/base/same_recording.h"
#include "core/diagnosis/evidence/read_evidence.h"
#include "core/diagnosis/report/report_json.h"
#include "core/table_files/read_columns.h"

namespace capstan::diagnosis {
namespace {

constexpr double kReadingShare = 0.1;  ///< share of the progress bar for reading

bool isPoses(const std::string& file) { return isPoseTable(table_files::columnNames(file)); }

void checkDistinct(const std::vector<std::string>& files) {
  for (std::size_t i = 0; i < files.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (base::sameRecording(files[j], files[i]))
        throw base::InputError({files[i],
                                0,
                                {},
                                {},
                                "is the same recording as " + files[j] + ": it would count twice",
                                "Give each recording once"});
}

/// Robot that the recordings contain, or `otherwise` if none contains one.
robot::Description broughtRobot(const std::vector<Evidence>& recordings,
                                const robot::Description& otherwise) {
  const Evidence* first = nullptr;
  for (const Evidence& evidence : recordings) {
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

/// Evidence of all files; if `progress` is cancelled, of the files read until then.
std::vector<Evidence> readAll(const DiagnosisRequest& request, const robot::Description& robot,
                              base::Progress& progress) {
  std::vector<Evidence> recordings;
  for (const std::string& file : request.files) {
    progress.report(
        kReadingShare * static_cast<double>(recordings.size()) / static_cast<double>(request.files.size()),
        "reading " + std::filesystem::path(file).filename().string());
    try {
      recordings.push_back(readEvidence(file, robot, request.evidence, &progress));
    } catch (const base::InputError&) {
      if (!progress.cancelled()) throw;  // what was read until then may hold too little
    }
    if (progress.cancelled()) break;
  }
  return recordings;
}

PoseReport diagnosePoseTable(const DiagnosisRequest& request, const robot::Description& nominal,
                             base::Progress& progress) {
  PoseOptions options;
  options.towards = request.towards;
  options.only = request.options.only;
  options.seed = request.options.seed;
  options.material = request.options.material;
  return diagnosePoses(readPoseEvidence(request.files.front()), nominal, options, &progress);
}

}  // namespace

const Report& FilesDiagnosis::report() const {
  if (const auto* poses = std::get_if<PoseReport>(&found)) return poses->report;
  return std::get<Report>(found);
}

nlohmann::json jsonOf(const FilesDiagnosis& diagnosis) {
  return std::visit([](const auto& found) { return jsonOf(found); }, diagnosis.found);
}

bool arePoseTables(const std::vector<std::string>& files) {
  for (const std::string& file : files)
    if (isPoses(file)) {
      if (files.size() == 1) return true;
      throw base::InputError(
          {file, 0, {}, {}, "is a table of tip poses among other recordings", "Diagnose it by itself"});
    }
  return false;
}

FilesDiagnosis diagnoseFiles(const DiagnosisRequest& request, base::Progress& progress,
                             const Diagnose& diagnose) {
  checkDistinct(request.files);
  robot::Description nominal = robot::readDescriptionOrDefault(request.robot);
  if (arePoseTables(request.files)) {
    PoseReport poses = diagnosePoseTable(request, nominal, progress);
    return {std::move(nominal), std::move(poses)};
  }
  const std::vector<Evidence> recordings = readAll(request, nominal, progress);
  if (progress.cancelled()) {
    Report nothing;
    nothing.cancelled = true;
    return {std::move(nominal), std::move(nothing)};
  }
  if (request.robot.empty()) nominal = broughtRobot(recordings, nominal);
  Report report = diagnose(recordings, nominal, request.options, &progress);
  return {std::move(nominal), std::move(report)};
}

}  // namespace capstan::diagnosis
