#include "app/monitor/window.h"

#include <epoxy/gl.h>
#include <fmt/format.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <span>

#include "core/base/error.h"

namespace capstan::monitor {

namespace {

std::string last_error;

void keepError(int, const char* text) { last_error = text; }

std::span<GLFWmonitor*> monitors() {
  int count = 0;
  GLFWmonitor** all = glfwGetMonitors(&count);
  return {all, static_cast<std::size_t>(std::max(count, 0))};
}

GLFWmonitor* monitorOf(int display) {
  const auto all = monitors();
  if (display < 1 || static_cast<std::size_t>(display) > all.size())
    throw base::InputError({{},
                            0,
                            "--display",
                            std::to_string(display),
                            fmt::format("there are {} displays", all.size()),
                            "See --list-displays"});
  return all[static_cast<std::size_t>(display - 1)];
}

}  // namespace

WindowSystem::WindowSystem() {
  glfwSetErrorCallback(keepError);
  if (!glfwInit())
    throw base::InputError(
        {{}, 0, {}, {}, "no display: " + last_error, "Start it on a desktop, or with xvfb-run"});
}

WindowSystem::~WindowSystem() { glfwTerminate(); }

std::vector<std::string> WindowSystem::displays() const {
  std::vector<std::string> lines;
  for (GLFWmonitor* monitor : monitors()) {
    const GLFWvidmode* mode = glfwGetVideoMode(monitor);
    const std::string rate =
        mode && mode->refreshRate > 0 ? fmt::format("{} Hz", mode->refreshRate) : "rate not reported";
    lines.push_back(fmt::format("{}  {}  {} x {}  {}", lines.size() + 1, glfwGetMonitorName(monitor),
                                mode ? mode->width : 0, mode ? mode->height : 0, rate));
  }
  return lines;
}

Window::Window(const std::array<int, 2>& size, int display, bool full_screen)
    : windowed_(size), display_(display), full_screen_(full_screen) {
  monitorOf(display_);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);  // it stays when another display gets the focus
  window_ = glfwCreateWindow(size[0], size[1], "Capstan stereo monitor", nullptr, nullptr);
  if (!window_)
    throw base::InputError({{},
                            0,
                            {},
                            {},
                            "no window with OpenGL 3.3: " + last_error,
                            "Update the graphics driver, or set LIBGL_ALWAYS_SOFTWARE=1"});
  glfwSetWindowUserPointer(window_, this);
  glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int) {
    if (action == GLFW_PRESS) static_cast<Window*>(glfwGetWindowUserPointer(window))->keys_.push_back(key);
  });
  const auto expose = [](GLFWwindow* window) {
    static_cast<Window*>(glfwGetWindowUserPointer(window))->exposed_ = true;
  };
  glfwSetWindowRefreshCallback(window_, expose);
  glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* window, int, int) {
    static_cast<Window*>(glfwGetWindowUserPointer(window))->exposed_ = true;
  });
  glfwSetWindowPosCallback(window_, [](GLFWwindow* window, int, int) {  // rows are those of the display
    static_cast<Window*>(glfwGetWindowUserPointer(window))->exposed_ = true;
  });
  place();
  glfwShowWindow(window_);
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
}

Window::~Window() { glfwDestroyWindow(window_); }

void Window::wait(double seconds) {
  if (seconds > 0.0)
    glfwWaitEventsTimeout(seconds);
  else
    glfwPollEvents();
}

int Window::takeKey() {
  if (keys_.empty()) return 0;
  const int key = keys_.front();
  keys_.pop_front();
  return key;
}

bool Window::closed() const { return glfwWindowShouldClose(window_); }

bool Window::takeExposed() { return std::exchange(exposed_, false); }

std::array<int, 2> Window::size() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  return {width, height};
}

int Window::firstRow() const {
  if (full_screen_) return 0;
  int x = 0, y = 0;
  glfwGetWindowPos(window_, &x, &y);
  return y;
}

double Window::refreshPeriod() const {
  const GLFWvidmode* mode = glfwGetVideoMode(monitorOf(display_));
  constexpr int kUsual = 60;  // [Hz]
  return 1.0 / (mode && mode->refreshRate > 0 ? mode->refreshRate : kUsual);
}

void Window::place() {
  GLFWmonitor* monitor = monitorOf(display_);
  const GLFWvidmode* mode = glfwGetVideoMode(monitor);
  int x = 0, y = 0;
  glfwGetMonitorPos(monitor, &x, &y);
  if (full_screen_ && mode) {
    glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
  } else {
    const int left = mode ? std::max(0, (mode->width - windowed_[0]) / 2) : 0;
    const int top = mode ? std::max(0, (mode->height - windowed_[1]) / 2) : 0;
    glfwSetWindowMonitor(window_, nullptr, x + left, y + top, windowed_[0], windowed_[1], GLFW_DONT_CARE);
  }
  exposed_ = true;
}

void Window::toggleFullScreen() {
  if (!full_screen_) glfwGetWindowSize(window_, &windowed_[0], &windowed_[1]);
  full_screen_ = !full_screen_;
  place();
}

void Window::nextDisplay() {
  const auto all = monitors();
  display_ = all.empty() ? 1 : display_ % static_cast<int>(all.size()) + 1;
  if (!all.empty()) place();
}

void Window::swap() {
  glfwSwapBuffers(window_);
  glFinish();
}

}  // namespace capstan::monitor
