#pragma once

#include <memory>

#include "core/live/estimate_output.h"
#include "core/live/streams/address.h"

namespace capstan::live {

class RowStream;

/// Sends the estimates of a session as OpenIGTLink messages TRANSFORM to every program that connects, such as
/// 3D Slicer, at most kMostRate times a second of the session:
///     TipToBase      position of the tip and orientation of the last link, in frame 0
///     CameraToBase   the registration: pose of the left camera in frame 0; none without a registration
/// Translations are in mm. Times are the time of this computer at the first sample plus the session's time
/// since then. A program that reads too slowly loses whole messages.
class TipTransforms final : public EstimateOutput {
 public:
  /// Throws base::InputError where the port cannot be listened on.
  explicit TipTransforms(const Address& address);
  ~TipTransforms() override;

  Listener begin(const tracking::SourceInfo& info) override;
  /// "igtl://127.0.0.1:18944", with the port in use.
  std::string address() const override;

  static constexpr double kMostRate = 60.0;  ///< [1/s]: more than a screen shows

 private:
  class Session;
  std::shared_ptr<RowStream> stream_;
};

}  // namespace capstan::live
