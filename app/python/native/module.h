#pragma once

#include <pybind11/pybind11.h>

/// The module capstan._native: what the package capstan (app/python/capstan) calls. Each function adds the
/// part of one file to it.
namespace capstan::python {

void addTrack(pybind11::module_& module);
void addIdentify(pybind11::module_& module);
void addDiagnose(pybind11::module_& module);
void addLearn(pybind11::module_& module);
void addCorrection(pybind11::module_& module);
void addDetect(pybind11::module_& module);
void addKinematics(pybind11::module_& module);
void addRegister(pybind11::module_& module);
void addSession(pybind11::module_& module);

}  // namespace capstan::python
