# Debian's Python with NumPy, and pybind11, for the Python package (app/python). Without them everything else is built.
option(CAPSTAN_PYTHON "The Python package, where pybind11 and NumPy are found" ON)
set(CAPSTAN_PYTHON_FOUND OFF)
if(CAPSTAN_PYTHON AND NOT CAPSTAN_SANITIZE)  # an interpreter without the sanitizer cannot load such a module
  if(NOT DEFINED Python_EXECUTABLE AND EXISTS /usr/bin/python3)
    set(Python_EXECUTABLE /usr/bin/python3)  # another one on the PATH has not Debian's NumPy
  endif()
  find_package(Python 3.11 QUIET COMPONENTS Interpreter Development.Module NumPy)
  if(Python_FOUND)
    set(PYBIND11_FINDPYTHON ON)
    find_package(pybind11 2.10 CONFIG QUIET)
  endif()
  if(Python_FOUND AND pybind11_FOUND)
    set(CAPSTAN_PYTHON_FOUND ON)
  else()
    message(STATUS "Without the Python package: pybind11-dev, python3-dev or python3-numpy is not installed")
  endif()
endif()
