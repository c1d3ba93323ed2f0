#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/field.h"
#include "core/base/names.h"
#include "core/base/progress.h"
#include "core/vision/camera.h"

namespace capstan::vision {

/// Reason why a pair of images is excluded.
enum class ViewFault {
  kNone,
  kLeftUnreadable,
  kRightUnreadable,
  kWrongSize,
  kBoardNotInLeft,
  kBoardNotInRight,
  kBoardInNeither,
  kTooFewCorners,
  kBadView,
  kExcluded
};

/// Boards: a chessboard; a chessboard whose white squares hold markers (ChArUco), which may be seen in part;
/// a grid of markers (ArUco).
enum class BoardKind { kChessboard, kCharuco, kAruco };

/// Families of markers on a board: those of OpenCV with 250 markers, the original one and AprilTag's.
enum class BoardDictionary { k4x4, k5x5, k6x6, kOriginal, kAprilTag36h11 };

/// Image files in pairs: left[i] and right[i] were taken at the same time.
struct CalibrationInput {
  std::vector<std::filesystem::path> left, right;
};

/// Image pairs left*.EXT, right*.EXT (png, jpg, jpeg, bmp, tif, tiff, pgm) of a folder, sorted by name.
/// Throws base::InputError when the folder cannot be read, holds no pair, or an image has no partner.
CalibrationInput findStereoPairs(const std::filesystem::path& folder);

/// Options of the stereo calibration. The defaults are those of OpenCV's calibration sample, so that results
/// are comparable with published ones. The default corner window suits boards that fill the image. When
/// squares are hardly larger than the window, neighbouring corners disturb each other
/// (CalibrationView::crowded); a smaller window is then better.
struct CalibrationOptions {
  BoardKind board = BoardKind::kChessboard;
  int board_columns = 9;       ///< inner corners along a row; of an ArUco grid, markers
  int board_rows = 6;          ///< inner corners along a column; of an ArUco grid, markers
  double square_size = 0.025;  ///< side of a square; of an ArUco grid, from marker to marker [m]
  double marker_size = 0.018;  ///< side of a marker [m]; not for a chessboard
  BoardDictionary dictionary = BoardDictionary::k4x4;  ///< not for a chessboard
  bool square_pixels = true;                           ///< whether fx = fy
  bool fit_k3 = true;           ///< whether the third radial coefficient is fitted; otherwise it is 0
  double outlier_factor = 0.0;  ///< multiple of the median error beyond which a view is excluded; 0: never
  int corner_window = 11;       ///< half side of the sub-pixel corner window [px]

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.board, {"board", "", "chessboard, charuco or aruco", {}, false});
    field(self.board_columns, {"board_columns", "", "inner corners along a row", {3, 50}, false});
    field(self.board_rows, {"board_rows", "", "inner corners along a column", {3, 50}, false});
    field(self.square_size, {"square_size", "m", "side of a square", {1e-4, 1.0}, false});
    field(self.marker_size, {"marker_size", "m", "side of a marker", {1e-4, 1.0}, false});
    field(self.dictionary, {"dictionary", "", "family of the markers", {}, false});
    field(self.square_pixels, {"square_pixels", "", "one focal length for both axes", {}, false});
    field(self.fit_k3, {"fit_k3", "", "fit the third radial coefficient", {}, false});
    field(self.outlier_factor, {"outlier_factor",
                                "",
                                "exclude views beyond this multiple of the median error; 0: keep all",
                                {0, 100},
                                false});
    field(self.corner_window,
          {"corner_window", "px", "half side of the sub-pixel corner window", {2, 30}, false});
  }
};

/// One pair of images. Errors are RMS distances between found and projected corners [px]; 0 if unused.
struct CalibrationView {
  std::string left, right;  ///< file names
  ViewFault fault = ViewFault::kNone;
  double left_error = 0.0;  ///< error of the fit of the left camera alone, with this view's own pose [px]
  double right_error = 0.0;
  double stereo_error = 0.0;  ///< error of both images with one common pose and the fitted rig [px]
  /// RMS distance of the corners from the epipolar lines of the other image, without distortion [px].
  double epipolar_error = 0.0;
  double smallest_spacing = 0.0;  ///< smallest distance between neighbouring corners in both images [px]
  bool crowded = false;           ///< spacing below 1.5 corner windows, so that corners disturb each other
  bool outlying = false;          ///< used, but stereo_error is above three times the median of all views
  bool used() const { return fault == ViewFault::kNone; }
};

struct CameraCalibration {
  double rms = 0.0;                      ///< RMS reprojection error of all used views [px]
  double focal_sigma = 0.0;              ///< standard deviation of fx [px]
  std::array<double, 2> centre_sigma{};  ///< standard deviations of cx and cy [px]
};

/// How much of what a good calibration needs the views of one camera cover, each 0 to 1: positions across and
/// down the image, size of the board, and its tilt.
struct BoardCoverage {
  double x = 0.0, y = 0.0, size = 0.0, skew = 0.0;

  /// What is missing, as "the board near the left and right edges"; empty: enough.
  std::vector<std::string> missing() const;
};

struct CalibrationReport {
  StereoRig rig;
  CameraCalibration left, right;
  double stereo_rms = 0.0;    ///< RMS reprojection error of both cameras with one pose per view [px]
  double epipolar_rms = 0.0;  ///< RMS epipolar error of all used views [px]
  BoardCoverage left_coverage, right_coverage;
  /// Columns and rows of the chessboard that the images show where these are not the expected ones; else 0.
  std::array<int, 2> other_board{};
  int views_used = 0;
  std::vector<CalibrationView> views;  ///< all pairs, in input order
  bool cancelled = false;              ///< whether `progress` was cancelled; `rig` is then not valid
};

/// Computes the intrinsics of both cameras and the transform between them from images of a board. Throws
/// base::InputError when an option is out of its range, the lists differ in length, or fewer than three pairs
/// remain; if the images show a chessboard of another size, the error names that size.
CalibrationReport calibrateStereo(const CalibrationInput& input, const CalibrationOptions& options,
                                  base::Progress& progress);

}  // namespace capstan::vision

template <>
struct capstan::base::NamesOf<capstan::vision::ViewFault> {
  using F = capstan::vision::ViewFault;
  static constexpr std::array value = {std::pair{F::kNone, "used"},
                                       std::pair{F::kLeftUnreadable, "left image is unreadable"},
                                       std::pair{F::kRightUnreadable, "right image is unreadable"},
                                       std::pair{F::kWrongSize, "image size differs from the first pair's"},
                                       std::pair{F::kBoardNotInLeft, "board not seen in the left image"},
                                       std::pair{F::kBoardNotInRight, "board not seen in the right image"},
                                       std::pair{F::kBoardInNeither, "board seen in neither image"},
                                       std::pair{F::kTooFewCorners, "too few corners seen by both cameras"},
                                       std::pair{F::kExcluded, "excluded by hand"},
                                       std::pair{F::kBadView, "outlier: error far above the other views'"}};
};
template <>
struct capstan::base::NamesOf<capstan::vision::BoardKind> {
  using K = capstan::vision::BoardKind;
  static constexpr std::array value = {std::pair{K::kChessboard, "chessboard"},
                                       std::pair{K::kCharuco, "charuco"}, std::pair{K::kAruco, "aruco"}};
};
template <>
struct capstan::base::NamesOf<capstan::vision::BoardDictionary> {
  using D = capstan::vision::BoardDictionary;
  static constexpr std::array value = {std::pair{D::k4x4, "4x4"}, std::pair{D::k5x5, "5x5"},
                                       std::pair{D::k6x6, "6x6"}, std::pair{D::kOriginal, "original"},
                                       std::pair{D::kAprilTag36h11, "apriltag_36h11"}};
};
