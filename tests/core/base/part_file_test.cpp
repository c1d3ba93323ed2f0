#include "core/base/part_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "core/base/error.h"
#include "core/base/yaml.h"

namespace capstan::base {
namespace {

namespace fs = std::filesystem;

class PartFileTest : public testing::Test {
 protected:
  PartFileTest() : folder_(fs::temp_directory_path() / ("capstan_part_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~PartFileTest() override { fs::remove_all(folder_); }
  std::ptrdiff_t files() const { return std::distance(fs::directory_iterator(folder_), {}); }

  fs::path folder_;
};

TEST_F(PartFileTest, TheFormerFileStaysUntilTheNewOneIsWhole) {
  const fs::path target = folder_ / "a.txt";
  writeTextFile(target, "former");
  {
    const PartFile part(target);
    std::ofstream(part.path()) << "half";
    EXPECT_EQ(readTextFile(target), "former");
  }
  EXPECT_EQ(readTextFile(target), "former");
  EXPECT_EQ(files(), 1);
  {
    PartFile part(target);
    std::ofstream(part.path()) << "whole";
    part.commit();
  }
  EXPECT_EQ(readTextFile(target), "whole");
  EXPECT_EQ(files(), 1);
}

TEST_F(PartFileTest, AFolderInItsPlaceIsAnInputError) {
  fs::create_directories(folder_ / "taken");
  try {
    writeTextFile(folder_ / "taken", "text");
    ADD_FAILURE() << "wrote a file over a folder";
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().file, (folder_ / "taken").string());
    EXPECT_FALSE(error.fault().remedy.empty());
  }
  EXPECT_EQ(files(), 1) << "the part is left";
}

}  // namespace
}  // namespace capstan::base
