#include "app/python/native/errors.h"

#include <pybind11/pybind11.h>

#include <exception>
#include <filesystem>
#include <regex>
#include <string>

#include "core/base/error.h"

namespace capstan::python {
namespace {

namespace py = pybind11;

/// `text` with options of the command line by their Python names.
std::string withPythonNames(const std::string& text) {
  static const std::regex kOption("--([a-z]+(?:-[a-z]+)*)");
  std::string result;
  auto from = text.begin();
  for (std::sregex_iterator found(text.begin(), text.end(), kOption), end; found != end; ++found) {
    std::string name = (*found)[1];
    for (char& c : name)
      if (c == '-') c = '_';
    result.append(from, text.begin() + found->position());
    result += name;
    from = text.begin() + found->position() + found->length();
  }
  return result.append(from, text.end());
}

void raise(const base::InputFault& fault) {
  base::InputFault named = fault;
  for (std::string* part : {&named.key, &named.reason, &named.remedy}) *part = withPythonNames(*part);
  const std::string text = base::InputError(named).what();
  const py::object kind = py::module_::import("capstan._errors").attr("InputError");
  const auto optional = [](const std::string& part) -> py::object {
    return part.empty() ? py::object(py::none()) : py::object(py::str(part));
  };
  const py::object line = named.line > 0 ? py::object(py::int_(named.line)) : py::object(py::none());
  const py::object error = kind(text, optional(named.file), line, optional(named.key), optional(named.value),
                                named.reason, optional(named.remedy));
  PyErr_SetObject(kind.ptr(), error.ptr());
}

}  // namespace

void translateErrors() {
  py::register_local_exception_translator([](std::exception_ptr fault) {
    try {
      if (fault) std::rethrow_exception(fault);
    } catch (const base::InputError& error) {
      raise(error.fault());
    } catch (const std::filesystem::filesystem_error& error) {
      raise(
          {error.path1().string(), 0, {}, {}, error.code().message(), "Check the path and its permissions"});
    }
  });
}

}  // namespace capstan::python
