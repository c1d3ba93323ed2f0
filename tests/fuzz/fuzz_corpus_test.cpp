#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "tests/fuzz/fuzz_target.h"
#include "tests/support/folders.h"

namespace capstan::fuzz {
namespace {

std::vector<std::filesystem::path> corpusOf(const std::string& target) {
  std::vector<std::filesystem::path> files;
  const auto folder = std::filesystem::path(test::sourceFile("tests/fuzz/corpus")) / target;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

class FuzzCorpus : public ::testing::TestWithParam<std::size_t> {};

std::vector<std::size_t> indices() {
  std::vector<std::size_t> all(targets().size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  return all;
}

TEST_P(FuzzCorpus, EveryFileGivesAResultOrAClearError) {
  const Target& target = targets()[GetParam()];
  const auto files = corpusOf(target.name);
  EXPECT_GE(files.size(), 2U) << "too small a corpus of " << target.name;
  for (const auto& file : files) {
    SCOPED_TRACE(file.filename().string());
    std::ifstream in(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    EXPECT_NO_THROW(target.run(bytes));
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, FuzzCorpus, ::testing::ValuesIn(indices()),
                         [](const auto& one) { return targets()[one.param].name; });

}  // namespace
}  // namespace capstan::fuzz
