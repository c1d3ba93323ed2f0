#pragma once

#include <QSize>
#include <array>
#include <filesystem>
#include <memory>
#include <vector>

#include "widgets/figures/joint_figure.h"

namespace capstan::widgets {

/// Draws `figure` into a file by its ending: .png (pixels), .pdf or .svg (vectors, real text). `size` in
/// points of 1/96 inch. Needs no display. Throws base::InputError for another ending or an unwritable place.
void saveFigure(JointFigure& figure, const std::filesystem::path& path, QSize size);

/// The joint plots of `history` over [begin, end] on paper: light, no cursor; a figure for each joint where
/// all three would be too low.
std::vector<std::unique_ptr<JointFigure>> jointPages(const JointHistory& history,
                                                     const std::array<QString, 3>& joint_names, double begin,
                                                     double end, QSize size);

/// The same as a file, or as NAME-page-1 and so on. Same endings and errors.
void saveJointFigure(const JointHistory& history, const std::array<QString, 3>& joint_names, double begin,
                     double end, const std::filesystem::path& path, QSize size = {1200, 900});

/// The numbers behind them as CSV, a row a time: t [s], then of each joint true, kinematic, camera (at its
/// own times), UKF and its sigma, in deg, deg, mm; empty where there is none. Of time before
/// history.detailBegin() a row each for the lowest and the highest values of every block, named in two more
/// columns: "block [s]", its length, and "of block". Throws base::InputError for an unwritable place.
void saveJointTable(const JointHistory& history, double begin, double end, const std::filesystem::path& path);

/// All of it: base.pdf, base.svg, base.png and base.csv. Throws base::InputError.
void exportJointFigure(const JointHistory& history, const std::array<QString, 3>& joint_names, double begin,
                       double end, const std::filesystem::path& base, QSize size = {1200, 900});

}  // namespace capstan::widgets
