#pragma once

#include <pybind11/pybind11.h>

#include <nlohmann/json.hpp>

namespace capstan::python {

/// Python object of a JSON document, equal to what json.loads() gives of its text: dict, list, str, int,
/// float, bool. Numbers keep every bit; NaN is None.
pybind11::object toPython(const nlohmann::json& document);

/// The document of `capstan-cli … --json`: with the key "schema".
pybind11::object documentToPython(nlohmann::json document);

}  // namespace capstan::python
