#pragma once

#include <QSize>
#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "widgets/figures/joint_figure.h"

namespace capstan::widgets {

/// Writes `figure` to a file by its ending: .png (pixels), .pdf or .svg (vectors, text as text). `size` in
/// points of 1/96 inch. Needs no display. Throws base::InputError for another ending or a path that cannot be
/// written.
void saveFigure(JointFigure& figure, const std::filesystem::path& path, QSize size);

/// The joint plots of `history` over [begin, end] on paper: light theme, no cursor; one figure per joint
/// where all three would be too low.
std::vector<std::unique_ptr<JointFigure>> jointPages(const JointHistory& history,
                                                     const std::array<QString, 3>& joint_names, double begin,
                                                     double end, QSize size);

/// Writes the joint plots to a file, or to NAME-page-1 and so on, and returns the files. Endings and errors
/// as saveFigure().
std::vector<std::filesystem::path> saveJointFigure(const JointHistory& history,
                                                   const std::array<QString, 3>& joint_names, double begin,
                                                   double end, const std::filesystem::path& path,
                                                   QSize size = {1200, 900});

/// The values of the joint plots as CSV, one row per time: t [s], then for each joint true, kinematic,
/// camera (at its own times), UKF and its sigma, in deg, deg, mm; cells without a value are empty. Before
/// history.detailBegin(), each block has two rows, one with its lowest and one with its highest values. The
/// table then has two more columns: "block [s]" is the length of the block, "of block" says lowest or
/// highest.
std::string jointTable(const JointHistory& history, double begin, double end);

/// Writes jointTable(). Throws base::InputError for a path that cannot be written.
void saveJointTable(const JointHistory& history, double begin, double end, const std::filesystem::path& path);

/// Writes base.pdf, base.svg, base.png and base.csv, and returns the files. Throws base::InputError.
std::vector<std::filesystem::path> exportJointFigure(const JointHistory& history,
                                                     const std::array<QString, 3>& joint_names, double begin,
                                                     double end, const std::filesystem::path& base,
                                                     QSize size = {1200, 900});

}  // namespace capstan::widgets
