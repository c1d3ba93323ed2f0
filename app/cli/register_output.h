#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/registration/pair_registration.h"
#include "core/registration/pair_table.h"
#include "core/vision/triangulation.h"

namespace capstan::cli {

/// Points of a table of pairs, and their registration.
struct Registered {
  registration::PairPoints points;
  std::size_t rows = 0;  ///< number of rows of the table
  registration::PairRegistration fit;
};

/// Registers the cameras from `rows` of the table `file`. Rows with pixels need `triangulator`; with
/// `exchange`, their left pixels are taken as right and the right as left. Throws base::InputError with the
/// reason and a remedy where the rows give no registration.
Registered registerRows(std::vector<registration::PairRow> rows,
                        const std::optional<vision::Triangulator>& triangulator, bool exchange,
                        const std::string& file);

nlohmann::json documentOf(const Registered& found);

/// Table of the residuals for people, row by row [mm], and whether the row was used. Of more than 20 rows,
/// the ten with the largest residuals and a line about the others.
std::string residualTable(const Registered& found);

}  // namespace capstan::cli
