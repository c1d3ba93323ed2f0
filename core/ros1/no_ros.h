#pragma once

#include <string>

#include "core/base/error.h"

namespace capstan::ros1 {

/// The error of a program that was built without ROS 1, about a file or an address that needs it.
inline base::InputError withoutRos(const std::string& what) {
  return base::InputError({what,
                           0,
                           {},
                           {},
                           "needs ROS 1, without which this program was built",
                           "Install the package capstan-ros. In a build of your own: install libroscpp-dev, "
                           "libsensor-msgs-dev, libgeometry-msgs-dev and librosbag-storage-dev, and "
                           "build again"});
}

}  // namespace capstan::ros1
