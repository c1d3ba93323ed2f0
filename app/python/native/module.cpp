#include "app/python/native/module.h"

#include "app/python/native/errors.h"
#include "core/base/software.h"

PYBIND11_MODULE(_native, module) {
  using namespace capstan;
  module.doc() = "Compiled part of the package capstan";
  module.attr("version") = base::version();
  module.attr("software") = base::software();
  python::translateErrors();
  python::addTrack(module);
  python::addIdentify(module);
  python::addDiagnose(module);
  python::addCorrection(module);
  python::addLearn(module);
  python::addDetect(module);
  python::addKinematics(module);
  python::addRegister(module);
  python::addSession(module);
}
