#include <gmock/gmock.h>

#include <cmath>

#include "core/table_files/json_lines.h"
#include "tests/core/table_files/sample_table.h"

namespace capstan::table_files {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::NanSensitiveDoubleEq;

TEST_F(TableFiles, JsonLinesMayLackKeysAndBeginThemLate) {
  write("a.jsonl",
        "{\"t\": 1, \"note\": {\"by\": [1, {\"t\": 2}]}}\r\n{\"q1\": -2.5e-1, \"t\": 2}\n{\"t\": 3, \"q1\": "
        "null}\n\n");
  Columns columns;
  columnsIn(path("a.jsonl")).read([&](std::string_view name, std::size_t) -> std::vector<double>* {
    return name == "note" ? nullptr : &columns[std::string(name)];
  });
  const double none = std::nan("");
  EXPECT_THAT(columns.at("t"), ElementsAre(1.0, 2.0, 3.0));
  EXPECT_THAT(columns.at("q1"), ElementsAre(NanSensitiveDoubleEq(none), NanSensitiveDoubleEq(-0.25),
                                            NanSensitiveDoubleEq(none)));
}

TEST_F(TableFiles, JsonLinesErrorsNameLineKeyAndValue) {
  const std::map<std::string, std::string> errors = {
      {"{\"t\": 1}\n{\"t\": \"two\"}\n",
       "a.jsonl:2: t = two: is not a finite number. Write a decimal number"},
      {"{\"t\": 1, \"t\": 2}\n", "a.jsonl:1: t: is in this object twice"},
      {"{\"t\": 1}\n\n{\"t\": 2}\n", "a.jsonl:2: is empty"},
      {"{\"t\": NaN}\n", "a.jsonl:1: is not JSON from byte 7 on"},
      {"{\"t\": 1} {\"t\": 2}\n", "a.jsonl:1: is not JSON"},
      {"{\"t\": 1e999}\n", "a.jsonl:1: is not JSON"},
      {"[{\"t\": 1}]\n", "is no JSON object"},
      {"12\n", "is no JSON object"},
      {"{\"t\": [1]}\n", "a.jsonl:1: t = […]: is not a finite number"},
      {"{\"t\": true}\n", "a.jsonl:1: t = true: is not a finite number"},
      {"", "a.jsonl:1: has no rows"},
      {"{\"t\": 1}\n{\"t\": 1" + std::string(kLongestJsonLine, ' ') + "}\n",
       "a.jsonl:2: has more than 65536 bytes"},
  };
  for (const auto& [text, error] : errors) {
    write("a.jsonl", text);
    EXPECT_THAT(errorOf(path("a.jsonl")), HasSubstr(error)) << text.substr(0, 40);
  }
}

TEST_F(TableFiles, PandasReadsAndWritesJsonLines) {
  if (std::system("/usr/bin/python3 -c 'import pandas' 2>/dev/null") != 0)
    GTEST_SKIP() << "needs python3-pandas";
  writeAll("a.jsonl", {{"t", {1.0, 2.0}}, {"q1", {1.0 / 3.0, std::nan("")}}});
  ASSERT_TRUE(
      python("import pandas as pd\nf = pd.read_json('a.jsonl', lines=True, precise_float=True)\n"
             "assert f.q1[0] == 1 / 3 and np.isnan(f.q1[1])\n"
             "f.to_json('b.jsonl', orient='records', lines=True, double_precision=15)\n"));
  const Columns back = readAll(path("b.jsonl"));
  EXPECT_NEAR(back.at("q1")[0], 1.0 / 3.0, 1e-15);
  EXPECT_TRUE(std::isnan(back.at("q1")[1]));
}

}  // namespace
}  // namespace capstan::table_files
