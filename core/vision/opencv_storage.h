#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

namespace capstan::vision {

/// Parses the text of a file of cv::FileStorage: XML if it begins with "<", else YAML or JSON. A matrix is a
/// block of rows, cols, dt and the list data. cv::FileStorage itself is not used: wrong files crash it, and
/// deeply nested ones exhaust the stack. Throws base::InputError under the name `file`.
YAML::Node parseOpenCvStorage(const std::string& text, const std::string& file);

}  // namespace capstan::vision
