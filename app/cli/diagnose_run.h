#pragma once

#include <string>
#include <vector>

#include "app/cli/command.h"
#include "core/diagnosis/diagnose_files.h"

namespace capstan::cli {

/// Arguments of `capstan-cli diagnose`.
struct DiagnoseArguments {
  std::vector<std::string> files;
  std::string robot, json, report, out, next;  ///< values of the options; empty: not given
  std::string towards;      ///< reference of tip poses: kinematics, command; empty: chosen by the table
  std::string zeros;        ///< zeros of joint encoders: known, shared, each; empty: options.zeros
  double skip_start = 0.0;  ///< initial time that is not compared [s]
  std::string read_as;      ///< units of tables, in the format of recording::parseReadAs()
  std::string material;     ///< as diagnosis::parseTolerance() takes it; empty: its default
  diagnosis::DiagnosisOptions options;
};

/// Reads the files, diagnoses them and writes the outputs. Returns kFailed if it was cancelled. Throws
/// base::InputError for unusable files, options and outputs, before anything is computed.
ExitCode runDiagnose(const DiagnoseArguments& arguments,
                     const diagnosis::Diagnose& diagnose = diagnosis::diagnose);

}  // namespace capstan::cli
