#pragma once

#include <filesystem>

#include "core/experiments/correction_experiment.h"

namespace capstan::cli {

/// Figures of an experiment E to H as PDF, SVG, PNG and CSV: box plots of errors by method (E), errors by
/// number of training states (F), box plots of distances on arrival (G), of time and grasp error a fragment
/// (H).
void drawFigures(const experiments::CorrectionExperimentResults& results,
                 const std::filesystem::path& folder);

}  // namespace capstan::cli
