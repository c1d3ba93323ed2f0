#include "widgets/scene/vtk_version.h"

#include <vtkVersion.h>

namespace capstan::widgets {

std::string vtkVersionText() { return vtkVersion::GetVTKVersion(); }

}  // namespace capstan::widgets
