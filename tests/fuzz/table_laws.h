#pragma once

#include <cmath>

#include "core/recording/measured_table.h"
#include "tests/fuzz/fuzz_target.h"

namespace capstan::fuzz {

inline void requireColumns(const recording::MeasuredTable& table) {
  require(table.rows() > 0, "a table has rows");
  for (const recording::TableColumns* quantity :
       {&table.q_m, &table.dq_m, &table.tau_m, &table.q, &table.p_c, &table.tau_ext})
    for (const std::vector<double>& column : *quantity) {
      require(column.size() == table.rows(), "columns have the same number of rows");
      for (const double value : column) require(!std::isinf(value), "values are finite or absent");
    }
}

/// What holds for every measured table that is accepted.
inline void requireTable(const recording::MeasuredTable& table) {
  requireColumns(table);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    require(std::isfinite(table.t[row]), "times are finite");
    require(row == 0 || table.t[row] > table.t[row - 1], "times rise");
  }
}

}  // namespace capstan::fuzz
