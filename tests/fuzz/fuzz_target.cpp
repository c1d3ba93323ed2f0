#include "tests/fuzz/fuzz_target.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "core/base/error.h"

namespace capstan::fuzz {
namespace {

/// A folder that is removed when the process ends.
class Folder {
 public:
  Folder() : path_(std::filesystem::temp_directory_path() / ("capstan-fuzz-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

const Folder& folder() {
  static const Folder folder;
  return folder;
}

}  // namespace

std::vector<Target>& targets() {
  static std::vector<Target> all;
  return all;
}

bool addTarget(std::string name, std::function<void(std::string_view bytes)> run) {
  targets().push_back({std::move(name), std::move(run)});
  return true;
}

void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "contradicts the interface: %s\n", what);
  std::abort();
}

void allowInputError(const std::function<void()>& work) {
  constexpr std::size_t kLongest = 20000;
  try {
    work();
  } catch (const base::InputError& error) {
    const std::string text = error.what();
    require(!error.fault().file.empty(), "an error names the input");
    require(!error.fault().reason.empty(), "an error has a reason");
    require(text.size() < kLongest, "an error can be read by a person");
    require(text.find(error.fault().remedy) != std::string::npos, "an error shows its remedy");
  }
}

std::filesystem::path fileOf(std::string_view bytes, const std::string& name) {
  const std::filesystem::path path = folder().path() / name;
  std::filesystem::create_directories(path.parent_path());
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  require(out.good(), "the folder for temporary files can be written");
  return path;
}

std::filesystem::path emptyFolder() {
  for (const auto& entry : std::filesystem::directory_iterator(folder().path()))
    std::filesystem::remove_all(entry.path());
  return folder().path();
}

std::vector<std::string> partsOf(std::string_view bytes, std::size_t count) {
  constexpr std::string_view kBetween = "\n====\n";
  std::vector<std::string> parts;
  while (parts.size() + 1 < count) {
    const std::size_t end = bytes.find(kBetween);
    parts.emplace_back(bytes.substr(0, end));
    bytes.remove_prefix(end == std::string_view::npos ? bytes.size() : end + kBetween.size());
  }
  parts.emplace_back(bytes);
  return parts;
}

}  // namespace capstan::fuzz
