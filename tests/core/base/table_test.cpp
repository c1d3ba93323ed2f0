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

}  // namespace
}  // namespace capstan::base
