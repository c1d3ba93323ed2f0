#pragma once

#include <memory>

class QApplication;

namespace capstan::cli {

/// What Qt needs to draw into files, while it lives; no display is asked for, not even a stale one.
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
