#include "core/vision/opencv_storage.h"

#include <algorithm>
#include <boost/property_tree/xml_parser.hpp>
#include <sstream>

#include "core/base/yaml.h"

namespace capstan::vision {
namespace {

using Tree = boost::property_tree::ptree;

[[noreturn]] void refuse(const std::string& file, int line, const std::string& reason,
                         const std::string& remedy) {
  throw base::InputError({file, line, {}, {}, reason, remedy});
}

/// A list of the words of a text, as XML has them.
YAML::Node listOf(const std::string& text) {
  YAML::Node list(YAML::NodeType::Sequence);
  std::istringstream words(text);
  for (std::string word; words >> word;) list.push_back(word);
  return list;
}

YAML::Node nodeOf(const Tree& tree, const std::string& file) {
  YAML::Node node(YAML::NodeType::Map);
  for (const auto& [key, value] : tree) {
    if (key.starts_with("<xml")) continue;  // attributes and comments
    if (node[key].IsDefined()) throw base::InputError({file, 0, key, {}, "is given twice", "Remove one"});
    if (key == "data")
      node[key] = listOf(value.data());
    else if (value.empty() || (value.size() == 1 && value.front().first.starts_with("<xml")))
      node[key] = value.data();
    else
      node[key] = nodeOf(value, file);
  }
  return node;
}

YAML::Node parseXml(const std::string& text, const std::string& file) {
  constexpr std::ptrdiff_t kMostElements = 1000;  // the parser calls itself for each level
  if (std::count(text.begin(), text.end(), '<') > 2 * kMostElements)
    refuse(file, 0, "has more than 1000 elements", "Write the calibration alone into a file");
  if (text.find('\0') != std::string::npos)
    refuse(file, 0, "is no text", "Write it again by cv::FileStorage");
  Tree tree;
  try {
    std::istringstream stream(text);
    boost::property_tree::read_xml(stream, tree, boost::property_tree::xml_parser::trim_whitespace);
  } catch (const boost::property_tree::xml_parser_error& error) {
    refuse(file, static_cast<int>(error.line()), "is not XML: " + error.message(),
           "Write it again by cv::FileStorage");
  }
  const auto storage = tree.get_child_optional("opencv_storage");
  if (!storage) refuse(file, 0, "has no element opencv_storage", "Write it by cv::FileStorage");
  return nodeOf(*storage, file);
}

}  // namespace

YAML::Node parseOpenCvStorage(const std::string& text, const std::string& file) {
  if (text.size() > base::kLongestYaml)
    refuse(file, 0, "has more than 1 MiB", "Write the calibration alone into a file");
  if (text.starts_with("<")) return parseXml(text, file);
  std::string yaml = text;
  if (yaml.starts_with(
          "%YAML"))  // YAML 1.0 in OpenCV's writing, which is no directive; lines keep their numbers
    std::fill_n(yaml.begin(), std::min(yaml.find('\n'), yaml.size()), ' ');
  return base::parseYamlText(yaml, file);
}

}  // namespace capstan::vision
