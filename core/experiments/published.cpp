#include "core/experiments/published.h"

#include "core/base/resource.h"
#include "core/base/yaml.h"

namespace capstan::experiments {

Published readPublished(const std::filesystem::path& file) {
  return base::readYamlFile<Published>(file.empty() ? base::resource("experiments/published.yaml") : file);
}

}  // namespace capstan::experiments
