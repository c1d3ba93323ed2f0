#pragma once

#include <string>
#include <vector>

#include "app/cli/command.h"
#include "core/diagnosis/diagnose_files.h"

namespace capstan::cli {

struct DiagnoseArguments {
  std::vector<std::string> files;
  std::string robot, json, report, out;  ///< empty: not given
  std::string towards;                   ///< of tip poses: kinematics, command; empty: what there is
  std::string zeros;                     ///< of encoders: known, shared, each; empty: options.zeros
  double skip_start = 0.0;               ///< [s]
  std::string read_as;                   ///< units of tables, as recording::parseReadAs() takes them
  diagnosis::DiagnosisOptions options;
};

/// The command behind its options: reads, diagnoses and writes. kFailed: cancelled. Throws base::InputError
/// for files, options and outputs that will not do, before anything is computed.
ExitCode runDiagnose(const DiagnoseArguments& arguments,
                     const diagnosis::Diagnose& diagnose = diagnosis::diagnose);

}  // namespace capstan::cli
