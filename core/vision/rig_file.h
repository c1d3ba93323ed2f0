#pragma once

#include <filesystem>
#include <string>

#include "core/vision/camera.h"

/// Calibrations of stereo cameras in the files of other programs.
namespace capstan::vision {

/// "a folder with left.yaml and right.yaml (ROS camera_info), …", for help texts and errors.
std::string rigFileKinds();

/// Reads a calibrated pair of cameras at `path`, which is one of
/// - a folder with left.yaml and right.yaml, or one of these two files: ROS camera_info, see readStereoRig();
/// - a Kalibr file camchain.yaml, or a folder with one *camchain*.yaml: see readKalibr();
/// - an OpenCV file (.yml, .yaml, .xml, .json of cv::FileStorage), or a folder with intrinsics and
///   extrinsics, as OpenCV's sample stereo_calib writes them (.yml or .xml): see readOpenCvRig().
/// Throws base::InputError with file, key, value and remedy.
StereoRig readRig(const std::filesystem::path& path);

/// Reads cam0 and cam1 of a Kalibr camera chain: camera_model pinhole, distortion_model radtan (k1, k2, p1,
/// p2) or none, T_cn_cnm1 of cam1 (points of cam0 into the frame of cam1) [m]. The camera that is physically
/// on the left is the rig's left one. Throws base::InputError for other models, naming the line.
StereoRig readKalibr(const std::filesystem::path& path);

/// Reads M1, D1, M2, D2 (intrinsics) and R, T (points of camera 1 into the frame of camera 2) [m] from one
/// OpenCV file, or R, T from `extrinsics`. The image size is image_width and image_height. Distortion has
/// four or five coefficients; more must be zero. Throws base::InputError.
StereoRig readOpenCvRig(const std::filesystem::path& path, const std::filesystem::path& extrinsics = {});
/// Writes such a file; the suffix (.yml, .xml, .json) selects the format. Throws base::InputError when it
/// cannot be written.
void writeOpenCvRig(const StereoRig& rig, const std::filesystem::path& path);

/// Completes a rig from two cameras and the transform from the first to the second, and checks that they are
/// side by side; exchanges them where the second is the left one. `file` and `key` are for errors: those of
/// the transform.
StereoRig sideBySide(const Camera& first, const Camera& second, const Eigen::Matrix3d& rotation,
                     const Eigen::Vector3d& translation, const std::string& file, const std::string& key);

}  // namespace capstan::vision
