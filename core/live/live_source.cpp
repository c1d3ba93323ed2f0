#include "core/live/live_source.h"

#include <limits>

#include "core/live/streams/address.h"
#include "core/tracking/arrival.h"

namespace capstan::live {
namespace {

constexpr std::size_t kCapacity = 60000;  // samples: 20 s of 1 kHz with joint encoders and cameras

}  // namespace

LiveSource::LiveSource(const LiveSetup& setup) : setup_(setup.motors), queue_(kCapacity) {
  const Address address = parseAddress(setup.motors.from, "motors.from");
  const bool piped = address.kind == Address::Kind::kStandardInput;
  info_.title = setup.title;
  info_.robot = robot::readDescriptionOrDefault(setup.robot);
  info_.reference = setup.motors.reference;
  info_.real_time = true;
  std::unique_ptr<ByteStream> stream = openByteStream(address);
  RowParser parser(stream->name(), info_.robot,
                   recording::parseReadAs(setup.motors.read_as, "motors.read_as"));
  rows_ = std::make_unique<RowSide>(std::move(stream), std::move(parser), info_.robot,
                                    piped ? RowSide::Faults::kEnd : RowSide::Faults::kDisconnect, queue_);
  if (!piped) return;
  const RowFacts facts = rows_->waitForFirst();
  info_.reference = facts.reference;
  info_.begin = facts.begin;
  info_.notices = facts.notices;
}

bool LiveSource::next(tracking::Sample& out) {
  if (!queue_.take(out)) {
    rows_->rethrow();
    return false;
  }
  const double t = tracking::arrivalOf(out);
  if (!begin_) begin_ = t;
  if (duration_ > 0.0 && t - *begin_ > duration_) return false;
  if (auto* motor = std::get_if<tracking::MotorSample>(&out)) arrange(*motor);
  if (auto* tip = std::get_if<tracking::TipSample>(&out); tip && blocked_)
    tip->position.setConstant(std::numeric_limits<double>::quiet_NaN());
  return true;
}

void LiveSource::arrange(tracking::MotorSample& sample) const {
  const tracking::MotorSample given = sample;
  for (int k = 0; k < 3; ++k) {
    const auto joint = static_cast<std::size_t>(k);
    const int from = setup_.motors[joint] - 1;
    sample.position[k] = setup_.signs[joint] * given.position[from];
    sample.velocity[k] = setup_.signs[joint] * given.velocity[from];
    sample.torque[k] = setup_.signs[joint] * given.torque[from];
  }
}

}  // namespace capstan::live
