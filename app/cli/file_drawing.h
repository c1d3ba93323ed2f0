#pragma once

#include <memory>

class QApplication;

namespace capstan::cli {

/// Qt application for drawing into files, for the lifetime of the object. It needs no display and ignores the
/// variable DISPLAY.
class FileDrawing {
 public:
  FileDrawing();
  ~FileDrawing();

 private:
  char name_[12] = "capstan-cli";
  char* arguments_[2] = {name_, nullptr};
  int count_ = 1;
  std::unique_ptr<QApplication> application_;
};

}  // namespace capstan::cli
