#include "app/python/native/json.h"

#include <cmath>
#include <string>

#include "app/cli/console.h"

namespace capstan::python {

namespace py = pybind11;

py::object toPython(const nlohmann::json& document) {
  using Kind = nlohmann::json::value_t;
  switch (document.type()) {
    case Kind::boolean:
      return py::bool_(document.get<bool>());
    case Kind::number_integer:
      return py::int_(document.get<std::int64_t>());
    case Kind::number_unsigned:
      return py::int_(document.get<std::uint64_t>());
    case Kind::number_float: {
      const double value = document.get<double>();
      if (!std::isfinite(value)) return py::none();
      return py::float_(value);
    }
    case Kind::string:
      return py::str(document.get_ref<const std::string&>());
    case Kind::array: {
      py::list list(document.size());
      for (std::size_t i = 0; i < document.size(); ++i) list[i] = toPython(document[i]);
      return list;
    }
    case Kind::object: {
      py::dict dict;
      for (const auto& [key, value] : document.items()) dict[py::str(key)] = toPython(value);
      return dict;
    }
    default:
      return py::none();
  }
}

py::object documentToPython(nlohmann::json document) {
  document["schema"] = cli::kJsonSchema;
  return toPython(document);
}

}  // namespace capstan::python
