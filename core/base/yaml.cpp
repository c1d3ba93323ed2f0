#include "core/base/yaml.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>

#include "core/base/edit_distance.h"
#include "core/base/part_file.h"

namespace capstan::base {
namespace {

std::string scalarText(const YAML::Node& node) {
  return node.IsDefined() && node.IsScalar() ? node.Scalar() : "";
}

int lineOf(const YAML::Node& node) {
  return node.IsDefined() && node.Mark().line >= 0 ? node.Mark().line + 1 : 0;
}

}  // namespace

void refuseYaml(const YAML::Node& node, const YamlPlace& place, const std::string& reason,
                const std::string& remedy) {
  throw InputError({place.file, lineOf(node), place.key, scalarText(node), reason, remedy});
}

void refuseLength(const YAML::Node& node, const YamlPlace& place, std::size_t wanted) {
  const std::size_t count = node.size();
  throw InputError(
      {place.file, lineOf(node), place.key, fmt::format("{} value{}", count, count == 1 ? "" : "s"),
       fmt::format("this list needs {}", wanted),
       fmt::format("Give {} values, as in {}: [{}]", wanted, place.key.substr(place.key.rfind('.') + 1),
                   fmt::join(std::vector<std::string>(wanted, "…"), ", "))});
}

std::string readTextFile(const std::filesystem::path& path, std::uint64_t most) {
  std::ifstream in(path, std::ios::binary);
  if (!in || std::filesystem::is_directory(path))
    throw InputError({path.string(), 0, {}, {}, "cannot be opened", "Check the path and its permissions"});
  if (std::filesystem::is_character_file(path) || std::filesystem::is_block_file(path))
    throw InputError({path.string(), 0, {}, {}, "is a device, not a file", "Give the path of a file"});
  constexpr std::size_t kPiece = 1U << 16;
  std::string text;
  while (in) {
    const std::size_t size = text.size();
    text.resize(size + kPiece);
    in.read(&text[size], kPiece);
    text.resize(size + static_cast<std::size_t>(in.gcount()));
    if (text.size() > most)
      throw InputError({path.string(),
                        0,
                        {},
                        {},
                        fmt::format("has more than {} bytes", most),
                        "Check that it is the file that you mean"});
  }
  return text;
}

void writeTextFile(const std::filesystem::path& path, const std::string& text) {
  PartFile part(path);
  {
    std::ofstream out(part.path(), std::ios::binary);
    out << text;
    out.flush();
    if (!out)
      throw InputError(
          {path.string(), 0, {}, {}, "cannot be written", "Check the folder, its permissions and the space"});
  }
  part.commit();
}

double yamlNumber(const YAML::Node& node, const YamlPlace& place, const FieldInfo& info) {
  double value = 0.0;
  if (!node.IsScalar() || !YAML::convert<double>::decode(node, value))
    refuseYaml(node, place, "is not a number", "Give a number: " + std::string(info.meaning));
  if (!std::isfinite(value)) refuseYaml(node, place, "is not finite");
  if (!info.range.contains(value)) {
    const std::string unit = info.unit.empty() ? "" : fmt::format(" {}", info.unit);
    refuseYaml(
        node, place,
        fmt::format("is outside the allowed range {:g} … {:g}{}", info.range.min, info.range.max, unit),
        std::string(info.meaning));
  }
  return value;
}

std::string remedyForUnknown(const std::string& key, const std::vector<std::string>& known) {
  constexpr std::size_t kMisspelt = 2;
  constexpr std::size_t kLongestKey = 64;
  if (known.empty()) return "Remove it";
  if (key.size() > kLongestKey) return fmt::format("Use one of: {}", fmt::join(known, ", "));
  const auto nearest = std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) {
    return editDistance(key, a) < editDistance(key, b);
  });
  const std::size_t distance = editDistance(key, *nearest);
  if (distance <= kMisspelt && distance < nearest->size()) return fmt::format("Did you mean {}?", *nearest);
  return fmt::format("Use one of: {}", fmt::join(known, ", "));
}

void refuseUnknownKeys(const YAML::Node& node, const YamlPlace& place,
                       const std::vector<std::string>& known) {
  for (const auto& entry : node) {
    const std::string key = entry.first.Scalar();
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    const std::string path = place.key.empty() ? key : place.key + "." + key;
    refuseYaml(entry.first, {place.file, path}, "is not a known key", remedyForUnknown(key, known));
  }
}

std::string yamlText(double value) { return fmt::format("{}", value); }

}  // namespace capstan::base
