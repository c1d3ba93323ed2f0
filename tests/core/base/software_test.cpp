// What results say of the program that computed them.
#include "core/base/software.h"

#include <gtest/gtest.h>

#include <regex>

namespace capstan::base {
namespace {

TEST(Software, IsNameVersionAndCommit) {
  const std::regex form(R"(capstan \d+\.\d+\.\d+( \([0-9a-f]{7,}(-dirty)?\))?)");
  EXPECT_TRUE(std::regex_match(software(), form)) << software();
  EXPECT_EQ(software("capstan-cli"), "capstan-cli" + software().substr(std::string("capstan").size()));
}

}  // namespace
}  // namespace capstan::base
