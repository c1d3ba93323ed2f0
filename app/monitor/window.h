#pragma once

#include <array>
#include <deque>
#include <string>
#include <vector>

struct GLFWwindow;

namespace capstan::monitor {

/// GLFW, from the first call to the last. Throws base::InputError if there is no display.
class WindowSystem {
 public:
  WindowSystem();
  ~WindowSystem();
  WindowSystem(const WindowSystem&) = delete;
  WindowSystem& operator=(const WindowSystem&) = delete;

  /// One line per display: number, name, size, refresh rate.
  std::vector<std::string> displays() const;
};

/// A window with an OpenGL 3.3 context, which is current. Swaps wait for the display's refresh.
class Window {
 public:
  /// On display `display` (from 1). Throws base::InputError if there is no such display or no OpenGL 3.3.
  Window(const std::array<int, 2>& size, int display, bool full_screen);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Takes events of keyboard and window, waiting for at most `seconds`.
  void wait(double seconds);
  /// Next pressed key (GLFW_KEY_…), 0: none.
  int takeKey();
  bool closed() const;
  /// The window has lost its contents since the last call.
  bool takeExposed();
  std::array<int, 2> size() const;  ///< [px]
  int firstRow() const;             ///< row of the display on which the window begins
  double refreshPeriod() const;     ///< of the display [s]; 1/60 s if it is not reported
  void toggleFullScreen();
  void nextDisplay();
  /// Shows what was drawn; returns when the graphics driver has done so.
  void swap();

 private:
  void place();

  GLFWwindow* window_ = nullptr;
  std::array<int, 2> windowed_;
  int display_;
  bool full_screen_;
  bool exposed_ = true;
  std::deque<int> keys_;
};

}  // namespace capstan::monitor
