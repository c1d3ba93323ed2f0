#include "core/base/part_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
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

TEST_F(PartFileTest, ALinkStaysAndWhatItPointsToIsReplaced) {
  fs::create_directories(folder_ / "far");
  writeTextFile(folder_ / "far/real.txt", "former");
  fs::create_symlink("far/real.txt", folder_ / "link.txt");
  fs::create_symlink("far/new.txt", folder_ / "dangling.txt");
  writeTextFile(folder_ / "link.txt", "new");
  writeTextFile(folder_ / "dangling.txt", "made");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.txt"));
  EXPECT_TRUE(fs::is_symlink(folder_ / "dangling.txt"));
  EXPECT_EQ(readTextFile(folder_ / "far/real.txt"), "new");
  EXPECT_EQ(readTextFile(folder_ / "far/new.txt"), "made");
}

TEST_F(PartFileTest, APipeIsWrittenToAndStays) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const int end = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  writeTextFile(pipe, "text");
  char got[8] = {};
  EXPECT_EQ(read(end, got, sizeof got), 4);
  close(end);
  EXPECT_TRUE(fs::is_fifo(pipe));
  EXPECT_EQ(files(), 1);
}

TEST_F(PartFileTest, WhatSqliteLeavesBesideAPartGoes) {
  {
    const PartFile part(folder_ / "a.capstan");
    for (const char* suffix : {"", "-journal", "-wal", "-shm"})
      std::ofstream(part.path().string() + suffix) << "x";
  }
  EXPECT_EQ(files(), 0);
}

TEST_F(PartFileTest, WhatCannotBeWrittenIsRefusedBeforehand) {
  fs::create_directories(folder_ / "taken");
  EXPECT_THROW(checkWritable(folder_ / "taken"), InputError);
  EXPECT_THROW(checkWritable(folder_ / "nowhere/a.txt"), InputError);
  EXPECT_THROW(checkWritable("/proc/a.txt"), InputError);
  EXPECT_NO_THROW(checkWritable(folder_ / "a.txt"));
  EXPECT_NO_THROW(checkWritable("a.txt"));
  EXPECT_EQ(files(), 1);
}

TEST(InputErrorTest, ALongValueIsCutBetweenCharacters) {
  const auto text = [](const std::string& value) {
    return std::string(InputError({{}, 0, "k", value, "is bad", {}}).what());
  };
  EXPECT_EQ(text("1.5"), "k = 1.5: is bad");
  EXPECT_STREQ(InputError({"f", 2, {}, "1.5", "is bad", "Mend it"}).what(), "f:2: 1.5: is bad. Mend it");
  EXPECT_EQ(text("one\ntwo"), "k = one…: is bad");
  std::string accents;
  for (int i = 0; i < 60; ++i) accents += "é";
  EXPECT_EQ(text("x" + accents), "k = x" + accents.substr(0, 78) + "…: is bad");
}

}  // namespace
}  // namespace capstan::base
