#pragma once

#include "core/live/blocking.h"
#include "core/tracking/source.h"

namespace capstan::live {

/// A source whose images are corrected.
class CorrectedSource final : public tracking::Source {
 public:
  /// `source` must outlive this object.
  CorrectedSource(tracking::Source& source, const vision::ImageCorrection& correction) : source_(source) {
    blocking_.setCorrection(correction);
  }

  const tracking::SourceInfo& info() const override { return source_.info(); }
  bool next(tracking::Sample& out) override {
    if (!source_.next(out)) return false;
    blocking_.correct(out);
    return true;
  }
  void block(bool left, bool right) override {
    blocking_.setByHand(left, right);
    blocking_.apply(0.0, source_);
  }

 private:
  tracking::Source& source_;
  Blocking blocking_;
};

}  // namespace capstan::live
