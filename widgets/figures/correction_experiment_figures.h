#pragma once

#include <filesystem>
#include <memory>

#include "core/experiments/correction_experiment.h"
#include "widgets/figures/panel_figure.h"

namespace capstan::widgets {

/// The figure of an experiment E to H: box plots of errors by method (E), errors by number of training states
/// (F), box plots of distances on arrival (G), box plots of time and grasp error by method (H).
std::unique_ptr<PanelFigure> figureOf(const experiments::CorrectionExperimentResults& results);

/// Writes comparison.md, numbers.json (jsonOf), the tables as CSV, LaTeX and Markdown, and the figure as PDF,
/// SVG, PNG and CSV into `folder`, which is created. Needs a QApplication, no display. Throws
/// base::InputError for a path that cannot be written.
void writeExperiment(const experiments::CorrectionExperimentResults& results,
                     const std::filesystem::path& folder);

}  // namespace capstan::widgets
