#pragma once

#include <string>

namespace capstan::base {

/// Line of the value at `key`, a path as in YamlPlace, in a YAML `text`, or of its deepest part that is
/// there; 0: there is none. `file` names the text in errors. Throws InputError as parseYamlText().
int yamlLine(const std::string& text, const std::string& file, const std::string& key);

}  // namespace capstan::base
