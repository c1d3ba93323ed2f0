#include "core/diagnosis/diagnose_files.h"
#include "core/recording/column_units.h"
#include "widgets/panels/diagnosis/diagnosis_choice.h"

namespace capstan::widgets {

diagnosis::Report runDiagnosis(const DiagnosisChoice& choice, base::Progress& progress) {
  diagnosis::DiagnosisRequest request{.files = {}, .robot = choice.robot.toStdString()};
  for (const QString& file : choice.recordings) request.files.push_back(file.toStdString());
  request.options.material = toleranceOf(choice.material);
  request.options.effort = choice.effort;
  request.evidence.read_as = recording::parseReadAs(choice.read_as.toStdString(), "units");
  return diagnosis::diagnoseFiles(request, progress).report();
}

}  // namespace capstan::widgets
