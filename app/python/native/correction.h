#pragma once

#include <memory>

#include "core/learning/model/correction_file.h"

namespace capstan::python {

/// A learned model and its source, as Python holds it.
using Correction = std::shared_ptr<learning::CorrectionFile>;

}  // namespace capstan::python
