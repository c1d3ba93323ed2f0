#pragma once

#include <string>

#include "core/base/error.h"
#include "core/base/yaml.h"
#include "core/live/live_setup.h"
#include "tests/support/temporary_folder.h"

namespace capstan::live {

/// Key that readLiveSetup() refuses in a set-up file with this text; empty: none. The error names the file.
inline std::string refusedKey(const std::string& text) {
  const test::TemporaryFolder folder;
  const auto path = folder / "setup.yaml";
  base::writeTextFile(path, text);
  try {
    readLiveSetup(path);
  } catch (const base::InputError& error) {
    return error.fault().file == path.string() ? error.fault().key : "file " + error.fault().file;
  }
  return {};
}

}  // namespace capstan::live
