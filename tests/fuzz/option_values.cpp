#include <cmath>

#include "core/base/error.h"
#include "core/diagnosis/report/tolerance.h"
#include "core/experiments/shard.h"
#include "core/live/play_faults.h"
#include "core/live/streams/address.h"
#include "core/recording/column_units.h"
#include "core/ros1/bag_topics.h"
#include "tests/fuzz/fuzz_target.h"

namespace {

/// An option's error names the option instead of a file.
void allowOptionError(const std::function<void()>& work) {
  using capstan::fuzz::require;
  try {
    work();
  } catch (const capstan::base::InputError& error) {
    require(!error.fault().key.empty(), "an error names the option");
    require(!error.fault().reason.empty() && !error.fault().remedy.empty(), "reason and remedy");
  }
}

}  // namespace

/// Value of an option of the command line: each text is read as each kind of them.
CAPSTAN_FUZZ_TARGET(option_values) {
  using namespace capstan;
  const std::string text(bytes), option = "--option";
  allowOptionError([&] { recording::parseReadAs(text, option); });
  allowOptionError([&] { ros1::parseBagTopics(text, option); });
  allowOptionError([&] {
    const experiments::Shard shard = experiments::parseShard(text);
    fuzz::require(shard.index >= 1 && shard.index <= shard.count, "a shard of a set");
  });
  allowOptionError([&] {
    const diagnosis::Tolerance tolerance = diagnosis::parseTolerance(text, option);
    fuzz::require(tolerance.angle >= 0.0 && tolerance.length >= 0.0, "a tolerance is not negative");
  });
  for (const auto parse : {live::parseRowFault, live::parseImageFault})
    allowOptionError([&] {
      const live::PlayFault fault = parse(text, option);
      fuzz::require(std::isfinite(fault.amount) && std::isfinite(fault.time), "a fault has finite numbers");
    });
  for (const auto parse : {live::parseAddress, live::parseIgtlAddress})
    allowOptionError([&] {
      const live::Address address = parse(text, option);
      fuzz::require(address.kind != live::Address::Kind::kTcp || !address.host.empty(), "a host");
    });
  allowOptionError([&] { fuzz::require(!live::parseHttpAddress(text, option).host.empty(), "a host"); });
}
