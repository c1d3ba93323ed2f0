#include "core/vision/marker_file.h"

#include "core/base/yaml.h"

namespace capstan::vision {

MarkerOptions readMarkerFile(const std::filesystem::path& path) {
  return base::readYamlFile<MarkerOptions>(path);
}

void writeMarkerFile(const MarkerOptions& marker, const std::filesystem::path& path) {
  base::writeTextFile(path, base::writeYaml(marker));
}

}  // namespace capstan::vision
