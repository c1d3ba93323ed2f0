#pragma once

#include <string>

namespace capstan::widgets {

/// Version of the VTK that this program was built with, as in "9.1.0".
std::string vtkVersionText();

}  // namespace capstan::widgets
