#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>

namespace capstan::recording {

/// What a list of recordings shows of one of them.
struct RecordingDigest {
  std::string created;    ///< creation time, ISO 8601; empty: not known
  double duration = 0.0;  ///< from the first sample to the last [s]; 0: not known
  std::string robot;      ///< name of the robot; empty: not known
  cv::Mat image;          ///< left image of the first pair, BGR; empty: none
};

/// Digest of a session file (.capstan), which may be under recording; of any other recording nothing is
/// known. `width`: width of the image [px], whose sides keep their ratio. Throws base::InputError for a file
/// that is missing or damaged.
RecordingDigest digestOf(const std::filesystem::path& recording, int width);

}  // namespace capstan::recording
