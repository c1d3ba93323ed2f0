#pragma once

#include <exception>

#include "core/base/error.h"
#include "core/live/runner.h"
#include "core/recording/recover.h"

namespace capstan::live {

/// Puts the reason of a failed run into `status`, and the session file if it is damaged and can be recovered.
inline void noteFault(const std::exception& error, RunStatus& status) {
  status.error = error.what();
  const auto* refused = dynamic_cast<const base::InputError*>(&error);
  if (refused && recording::isRecoverable(*refused)) status.damaged = refused->fault().file;
}

}  // namespace capstan::live
