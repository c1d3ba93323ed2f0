// Files of strangers that fuzzing asked about: made to exhaust memory or stack, to be read in part, or to
// hide numbers.
#include <gmock/gmock.h>

#include <fstream>

#include "core/base/yaml.h"
#include "tests/support/temporary_folder.h"

namespace capstan::base {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string errorOf(const std::string& text) {
  try {
    parseYamlText(text, "robot.yaml");
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

/// A billion values in nine lines: each list has nine times the one before.
std::string billionLaughs() {
  std::string text = "a: &a [1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (char name = 'b'; name < 'j'; ++name) {
    text += std::string(1, name) + ": &" + name + " [";
    for (int i = 0; i < 9; ++i) text += std::string(i ? ", *" : "*") + static_cast<char>(name - 1);
    text += "]\n";
  }
  return text;
}

TEST(HostileYaml, ExponentialAliasesAreRefused) {
  EXPECT_THAT(errorOf(billionLaughs()),
              AllOf(StartsWith("robot.yaml:"), HasSubstr("more than 200000 values")));
}

TEST(HostileYaml, AliasesOfUsualSizeAreRead) {
  const YAML::Node node = parseYamlText("a: &a {x: 1}\nb: *a\n", "robot.yaml");
  EXPECT_EQ(node["b"]["x"].Scalar(), "1");
}

TEST(HostileYaml, DepthIsLimited) {
  EXPECT_THAT(errorOf("a: &a [*a]\n"), HasSubstr("nested in more than 32 levels"));
  EXPECT_THAT(errorOf("a: " + std::string(100, '[') + std::string(100, ']')),
              HasSubstr("nested in more than 32 levels"));
  EXPECT_THAT(errorOf("a: " + std::string(100'000, '[')), HasSubstr("nested in more than 32 levels"));
  EXPECT_EQ(errorOf("a: " + std::string(30, '[') + std::string(30, ']')), "");
}

TEST(HostileYaml, LengthIsLimitedBeforeReadingOn) {
  EXPECT_THAT(errorOf("a: " + std::string(kLongestYaml, 'x')), HasSubstr("more than 1048576 bytes"));
  const test::TemporaryFolder folder;
  std::ofstream(folder / "long.yaml") << "a: " << std::string(kLongestYaml, 'x');
  try {
    readYamlTextFile(folder / "long.yaml");
    FAIL() << "was read";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("long.yaml"), HasSubstr("more than 1048576 bytes")));
  }
  EXPECT_THROW(readYamlTextFile("/dev/zero"), InputError);  // without end
}

TEST(HostileYaml, ADeviceIsNotReadWithoutEnd) {
  try {
    readTextFile("/dev/zero");
    FAIL() << "/dev/zero was read";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(StartsWith("/dev/zero"), HasSubstr("is a device, not a file")));
  }
}

TEST(HostileYaml, AKeyThatIsGivenTwiceIsRefused) {  // the first value counted, whatever the second was
  EXPECT_THAT(errorOf("mass: 1\nname: x\nmass: 2\n"),
              AllOf(StartsWith("robot.yaml:3: mass: is given twice"), HasSubstr("Remove one")));
  EXPECT_THAT(errorOf("? [a, b]\n: 1\n"), HasSubstr("is no key"));
}

TEST(HostileYaml, NothingIsReadInPart) {
  EXPECT_THAT(errorOf(std::string("mass: 1\n\x04gravity: 2\n")),
              StartsWith("robot.yaml:2: has the control character 0x04"));
  EXPECT_THAT(errorOf(std::string("a: 1\nb: \0\n", 10)),
              StartsWith("robot.yaml:2: has the control character 0x00"));
  EXPECT_THAT(errorOf("a: 1\n---\nb: 2\n"), HasSubstr("begins a second document"));
  EXPECT_THAT(errorOf("[1, 2]\n- 3\n"), HasSubstr("text behind the end of the first"));
  EXPECT_THAT(errorOf(","),
              HasSubstr("text behind the end of the first"));  // yaml-cpp's LoadAll() never returns
  EXPECT_THAT(errorOf(std::string("\xff\xfe"
                                  "a\0:\0",
                                  6)),
              HasSubstr("is not in UTF-8"));
}

struct Counts {
  int count = 0;
  std::uint64_t seed = 0;
  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.count, {"count", "", "how many", {}, false});
    field(self.seed, {"seed", "", "of random numbers", {}, false});
  }
};

TEST(HostileYaml, WholeNumbersBeyondTheirTypeAreRefused) {
  for (const char* text :
       {"count: 1e300", "count: 2147483648", "count: -2147483649", "seed: -1", "seed: 18446744073709551616"})
    EXPECT_THROW(readYaml<Counts>(text, "counts.yaml"), InputError) << text;
  EXPECT_EQ(readYaml<Counts>("count: -2147483648", "counts.yaml").count, std::numeric_limits<int>::min());
  EXPECT_EQ(readYaml<Counts>("count: 2147483647", "counts.yaml").count, std::numeric_limits<int>::max());
  EXPECT_EQ(readYaml<Counts>("seed: 18446744073709549568", "counts.yaml").seed, 18446744073709549568U);
}

TEST(HostileYaml, ErrorsCanBeReadAndShowTheirRemedy) {
  const InputError nul(
      {"a.csv", 3, std::string("q\0m", 3), std::string("\x1b[2J\0", 5), "is no number", "Write one"});
  EXPECT_STREQ(nul.what(), "a.csv:3: q\\x00m = \\x1b[2J\\x00: is no number. Write one");
  const InputError longest({"a.csv", 1, std::string(100'000, 'k'), {}, "is unknown", "Remove it"});
  EXPECT_LT(std::string(longest.what()).size(), 200U);
}

}  // namespace
}  // namespace capstan::base
