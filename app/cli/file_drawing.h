#pragma once

#include <memory>

class QApplication;

namespace capstan::cli {

/// What Qt needs to draw into files, while it lives; it needs no display, not even a stale DISPLAY variable.
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
