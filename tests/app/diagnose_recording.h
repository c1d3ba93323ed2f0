#pragma once

#include <filesystem>

#include "core/base/yaml.h"
#include "core/recording/measured_table.h"
#include "tests/support/sample_diagnosis.h"

namespace capstan::testing {

/// The sample's recording as a measured table.
inline void writeRecording(const std::filesystem::path& path, const SampleDiagnosis& sample = {},
                           int recording = 0) {
  const diagnosis::Evidence evidence = sampleEvidence(sample, recording);
  recording::MeasuredTable table;
  table.t = evidence.t;
  table.q_m = evidence.q_m;
  table.tau_m = evidence.tau_m;
  table.q = evidence.q;
  base::writeTextFile(path, recording::formatMeasuredTable(table));
}

}  // namespace capstan::testing
