#pragma once

#include <functional>

namespace capstan::widgets {

/// The thread of VTK. A renderer with its OpenGL context belongs to one thread; that is not the window's,
/// which paints the cameras' images while a scene is drawn. Tasks run one at a time, in the order of the
/// calls.
class RenderThread {
 public:
  /// Returns at once. What `task` refers to must live until it ran.
  static void post(std::function<void()> task);
  /// Returns when `task` and all before it have run.
  static void run(std::function<void()> task);
};

}  // namespace capstan::widgets
