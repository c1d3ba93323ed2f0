#include "core/base/table.h"

#include <gtest/gtest.h>

#include <limits>

namespace capstan::base {
namespace {

Table small() {
  Table table;
  table.title = "Errors & more";
  table.columns = {{"joint", ""}, {"RMS", "deg", 2}, {"P", "", 3, NumberStyle::kSignificant}};
  table.rows = {{"q_1", 1.2345, 2.59e-9}, {"a|b", -0.001, std::numeric_limits<double>::quiet_NaN()}};
  table.note = "100 % simulated";
  return table;
}

TEST(Table, MarkdownIsAlignedAndEscaped) {
  EXPECT_EQ(markdownOf(small()),
            "### Errors & more\n"
            "\n"
            "| joint | RMS [deg] |        P |\n"
            "|:------|----------:|---------:|\n"
            "| q_1   |      1.23 | 2.59e-09 |\n"
            "| a\\|b  |      0.00 |        – |\n"
            "\n"
            "100 % simulated\n");
}

TEST(Table, LatexUsesBooktabsAndEscapes) {
  EXPECT_EQ(latexOf(small(), "tab:errors"),
            "\\begin{table}\n"
            "  \\centering\n"
            "  \\caption{Errors \\& more}\n"
            "  \\label{tab:errors}\n"
            "  \\begin{tabular}{lrr}\n"
            "    \\toprule\n"
            "    joint & RMS [deg] & P \\\\\n"
            "    \\midrule\n"
            "    q\\_1 & 1.23 & $2.59 \\times 10^{-9}$ \\\\\n"
            "    a\\textbar{}b & 0.00 & -- \\\\\n"
            "    \\bottomrule\n"
            "  \\end{tabular}\n"
            "  \\par\\smallskip\n"
            "  {\\footnotesize 100 \\% simulated}\n"
            "\\end{table}\n");
}

TEST(Table, EveryLatexSpecialIsEscaped) {
  EXPECT_EQ(latexEscaped("\\&%$#_{}~^<>|"),
            "\\textbackslash{}\\&\\%\\$\\#\\_\\{\\}\\textasciitilde{}\\textasciicircum{}\\textless{}"
            "\\textgreater{}\\textbar{}");
  EXPECT_EQ(latexEscaped("59 ± 0.1 N·s/m – χ²"), "59 $\\pm$ 0.1 N$\\cdot$s/m -- $\\chi$$^2$");
}

TEST(Table, CsvKeepsEveryBitAndQuotes) {
  Table table = small();
  table.rows = {{"a,\"b\"", 0.1 + 0.2, std::numeric_limits<double>::infinity()}};
  EXPECT_EQ(csvOf(table), "joint,RMS [deg],P\n\"a,\"\"b\"\"\",0.30000000000000004,\n");
}

TEST(Table, GroupedCellsStandOnceForReadersAndAlwaysInACsv) {
  Table table;
  table.columns = {{"trial", "", 3, NumberStyle::kFixed, true},
                   {"duration", "s", 0, NumberStyle::kFixed, true},
                   {"joint", ""}};
  for (const char* trial : {"a", "b"})
    for (const char* joint : {"1", "2"}) table.rows.push_back({trial, 200.0, joint});
  EXPECT_EQ(csvOf(table), "trial,duration [s],joint\na,200,1\na,200,2\nb,200,1\nb,200,2\n");
  const std::string text = markdownOf(table);
  EXPECT_NE(text.find("| a     |          200 | 1     |\n|       |              | 2     |\n"
                      "| b     |          200 | 1     |\n|       |              | 2     |\n"),
            std::string::npos)
      << text;
  EXPECT_NE(latexOf(table).find("a & 200 & 1 \\\\\n     &  & 2"), std::string::npos) << latexOf(table);
}

}  // namespace
}  // namespace capstan::base
