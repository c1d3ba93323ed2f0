#include "core/base/yaml_line.h"

#include <algorithm>

#include "core/base/yaml.h"

namespace capstan::base {

int yamlLine(const std::string& text, const std::string& file, const std::string& key) {
  YAML::Node node = parseYamlText(text, file);
  for (std::size_t begin = 0; begin < key.size() && node.IsMap();) {
    const std::size_t end = std::min(key.find('.', begin), key.size());
    const YAML::Node inner = node[key.substr(begin, std::min(key.find('[', begin), end) - begin)];
    if (!inner.IsDefined()) break;
    node.reset(inner);
    begin = end + 1;
  }
  return node.Mark().line + 1;
}

}  // namespace capstan::base
