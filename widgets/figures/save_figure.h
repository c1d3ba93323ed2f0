#pragma once

#include <QSize>
#include <array>
#include <filesystem>

#include "widgets/figures/joint_figure.h"

namespace capstan::widgets {

/// Draws `figure` into a file by its ending: .png (pixels), .pdf or .svg (vectors, real text). `size` in
/// points of 1/96 inch. Needs no display. Throws base::InputError for another ending or an unwritable place.
void saveFigure(JointFigure& figure, const std::filesystem::path& path, QSize size);

/// The joint plots of `history` over [begin, end] on paper: light, no cursor. Same endings and errors.
void saveJointFigure(const JointHistory& history, const std::array<QString, 3>& joint_names, double begin,
                     double end, const std::filesystem::path& path, QSize size = {1200, 900});

}  // namespace capstan::widgets
