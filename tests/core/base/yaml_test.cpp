#include "core/base/yaml.h"
#include "core/base/yaml_line.h"

#include <gtest/gtest.h>

namespace capstan::base {
namespace {

enum class Kind { kA, kB };

struct Inner {
  double stiffness = 1.0;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.stiffness, {"stiffness", "N", "cable stiffness", {1.0, 1e7}});
    field(self.offset, {"offset", "m", "where it sits", {-1.0, 1.0}});
  }
};

struct Entry {
  static constexpr bool kMapEntry = true;
  std::string name;
  double size = 0.0;
  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.name, {"name", "", "its name"});
    field(self.size, {"size", "m", "how large", {0.0, 10.0}});
  }
};

struct Sparing {
  Kind kind = Kind::kA;
  std::vector<Entry> entries;
  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.kind, {"kind", "", "which kind", {}, false, true});
    field(self.entries, {"entries", "", "sizes by name", {}, false, true});
  }
};

struct Outer {
  std::string name;
  Kind kind = Kind::kA;
  std::vector<Inner> parts;
  std::optional<double> extra;
  int count = 3;
  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.name, {"name", "", "what it is called"});
    field(self.kind, {"kind", "", "which kind"});
    field(self.parts, {"parts", "", "its parts"});
    field(self.extra, {"extra", "s", "more"});
    field(self.count, {"count", "", "how many", {0, 10}, false});
  }
};

}  // namespace

template <>
struct NamesOf<Kind> {
  static constexpr std::array value = {std::pair{Kind::kA, "a"}, std::pair{Kind::kB, "b"}};
};

namespace {

const std::string kGood = "name: x\nkind: b\nparts:\n  - {stiffness: 2.5, offset: [0.1, 0, -0.3]}\n";

InputFault faultOf(const std::string& text) {
  try {
    readYaml<Outer>(text, "robot.yaml");
  } catch (const InputError& error) {
    return error.fault();
  }
  ADD_FAILURE() << "accepted: " << text;
  return {};
}

TEST(Yaml, ReadsEveryFieldType) {
  const auto outer = readYaml<Outer>(kGood, "robot.yaml");
  EXPECT_EQ(outer.kind, Kind::kB);
  ASSERT_EQ(outer.parts.size(), 1U);
  EXPECT_EQ(outer.parts[0].offset, Eigen::Vector3d(0.1, 0.0, -0.3));
  EXPECT_FALSE(outer.extra.has_value());
  EXPECT_EQ(outer.count, 3);
}

TEST(Yaml, WritesWhatItReadsToTheLastBit) {
  auto outer = readYaml<Outer>(kGood, "robot.yaml");
  outer.parts[0].stiffness = 1.0 / 3.0 + 1.0;
  outer.extra = 1e-300;
  const auto back = readYaml<Outer>(writeYaml(outer), "again");
  EXPECT_EQ(back.parts[0].stiffness, outer.parts[0].stiffness);
  EXPECT_EQ(back.extra, outer.extra);
}

TEST(Yaml, AnErrorNamesFileLineKeyValueAndRange) {
  const auto fault = faultOf("name: x\nkind: b\nparts:\n  - stiffness: 1e9\n    offset: [0, 0, 0]\n");
  EXPECT_EQ(fault.file, "robot.yaml");
  EXPECT_EQ(fault.line, 4);
  EXPECT_EQ(fault.key, "parts[0].stiffness");
  EXPECT_EQ(fault.value, "1e9");
  EXPECT_NE(fault.reason.find("1 … 1e+07 N"), std::string::npos) << fault.reason;
}

TEST(Yaml, RefusesWhatItDoesNotUnderstand) {
  EXPECT_EQ(faultOf("kind: b\nparts: []\n").key, "name");
  EXPECT_EQ(faultOf("name: x\nkind: c\nparts: []\n").reason, "is not one of: a, b");
  EXPECT_EQ(faultOf("name: x\nkind: a\nparts: []\ncuont: 3\n").remedy, "Did you mean count?");
  EXPECT_EQ(faultOf("name: x\nkind: a\nparts: []\ncount: 2.5\n").reason, "is not a whole number");
  EXPECT_EQ(faultOf("name: x\nkind: a\nparts: []\nextra: .nan\n").reason, "is not finite");
  EXPECT_EQ(faultOf("name: x\nkind: a\nparts:\n  - {stiffness: 2, offset: [1, 2]}\n").line, 4);
  EXPECT_EQ(faultOf("name: [x\n").line, 2);
}

TEST(Yaml, AnUnknownKeyComesBeforeAMissingOneAndIsCompared) {
  const auto fault = faultOf("nmae: x\nkind: a\nparts: []\n");  // name is missing, too
  EXPECT_EQ(fault.key, "nmae");
  EXPECT_EQ(fault.line, 1);
  EXPECT_EQ(fault.remedy, "Did you mean name?");
  // Nothing near: no guess, but what there is.
  EXPECT_EQ(faultOf("name: x\nkind: a\nparts: []\nvelocity: 3\n").remedy,
            "Use one of: name, kind, parts, extra, count");
  EXPECT_EQ(faultOf("name: x\nkind: a\nparts:\n  - {stiffness: 2, offset: [0, 0, 0], k_e: 1}\n").remedy,
            "Use one of: stiffness, offset");
}

TEST(Yaml, AListOfEntriesIsAMapInItsOrder) {
  const auto read = readYaml<Sparing>("kind: b\nentries: {zeta: 2.5, alpha: 0.1}\n", "sizes.yaml");
  ASSERT_EQ(read.entries.size(), 2U);
  EXPECT_EQ(read.entries[0].name, "zeta");
  EXPECT_EQ(read.entries[0].size, 2.5);
  EXPECT_EQ(read.entries[1].name, "alpha");
  EXPECT_EQ(writeYaml(read), "kind: b\nentries:\n  zeta: 2.5\n  alpha: 0.1\n");
  try {
    readYaml<Sparing>("entries:\n  zeta: 2.5\n  alpha: 11\n", "sizes.yaml");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.fault().key, "entries.alpha");
    EXPECT_EQ(error.fault().line, 3);
    EXPECT_EQ(error.fault().value, "11");
  }
  EXPECT_THROW(readYaml<Sparing>("entries: [1, 2]\n", "sizes.yaml"), InputError);
}

TEST(Yaml, WhatIsWrittenSparinglyIsLeftOutWherePlain) {
  EXPECT_EQ(writeYaml(Sparing{}), "{}\n");
  EXPECT_EQ(writeYaml(Sparing{Kind::kB, {}}), "kind: b\n");
  EXPECT_EQ(readYaml<Sparing>("{}", "sizes.yaml").kind, Kind::kA);
}

TEST(Yaml, AMissingFileIsAnInputError) {
  EXPECT_THROW(readYamlFile<Outer>("/nowhere/robot.yaml"), InputError);
}

TEST(Yaml, FindsTheLineOfAKey) {
  const std::string text = "a: 1\nb:\n  c: [1,\n    2]\n  d: x\n";
  EXPECT_EQ(yamlLine(text, "f", "a"), 1);
  EXPECT_EQ(yamlLine(text, "f", "b.c[1]"), 3);
  EXPECT_EQ(yamlLine(text, "f", "b.d"), 5);
  EXPECT_EQ(yamlLine(text, "f", "b.missing"), 3) << "of the block that lacks it";
  EXPECT_EQ(yamlLine(text, "f", "missing"), 1);
}

}  // namespace
}  // namespace capstan::base
