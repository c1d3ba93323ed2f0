#include "core/base/part_file.h"

#include <utility>

#include "core/base/error.h"

namespace capstan::base {

PartFile::PartFile(std::filesystem::path target) : PartFile(target, target.string() + ".part") {}

PartFile::PartFile(std::filesystem::path target, std::filesystem::path part)
    : target_(std::move(target)), part_(std::move(part)) {
  std::error_code fault;
  std::filesystem::remove(part_, fault);  // what is in the way shows when the part is opened
}

PartFile::~PartFile() {
  std::error_code fault;
  if (!part_.empty()) std::filesystem::remove(part_, fault);
}

void PartFile::commit() {
  std::error_code fault;
  std::filesystem::rename(part_, target_, fault);
  if (fault)
    throw InputError({target_.string(),
                      0,
                      {},
                      {},
                      "cannot be written: " + fault.message(),
                      "Choose another name, or check the folder and its permissions"});
  part_.clear();
}

}  // namespace capstan::base
