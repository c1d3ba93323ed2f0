#include "core/diagnosis/diagnose_files.h"
#include "widgets/panels/diagnosis/diagnosis_choice.h"

namespace capstan::widgets {

diagnosis::Report runDiagnosis(const DiagnosisChoice& choice, base::Progress& progress) {
  diagnosis::DiagnosisRequest request{.files = {}, .robot = choice.robot.toStdString()};
  for (const QString& file : choice.recordings) request.files.push_back(file.toStdString());
  request.options.material = toleranceOf(choice.material);
  return diagnosis::diagnoseFiles(request, progress).report();
}

}  // namespace capstan::widgets
