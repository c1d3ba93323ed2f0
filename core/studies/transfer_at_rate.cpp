#include "core/studies/transfer_at_rate.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>

#include "core/base/error.h"
#include "core/simulation/block_transfer.h"

namespace capstan::studies {

TransferAtRate::TransferAtRate(const robot::Description& robot, double speed, double duration,
                               std::uint64_t seed) {
  constexpr double kStep = 5e-3, kOrdinary = 200.0, kRest = 2.0;  // [s]
  static std::atomic<unsigned> count{0};
  file_ = std::filesystem::temp_directory_path() /
          fmt::format("capstan-transfer-{}-{}.csv", static_cast<long>(::getpid()), count++);
  const double length = speed * duration;
  const simulation::BlockTransfer path({}, std::max(kOrdinary, length + kRest), robot, seed);
  std::ofstream out(file_);
  out << "t,q1,q2,q3\n";
  const auto rows = static_cast<long>(std::ceil(duration / kStep));
  for (long row = 0; row <= rows; ++row) {
    const double t = static_cast<double>(row) * kStep;
    const Eigen::Vector3d q = path.at(speed * t).position;
    out << fmt::format("{},{:.17g},{:.17g},{:.17g}\n", t, q(0), q(1), q(2));
  }
  if (!out.flush())
    throw base::InputError({file_.string(),
                            0,
                            {},
                            {},
                            "cannot be written",
                            "Make room in the folder for temporary files, or name another in TMPDIR"});
}

TransferAtRate::~TransferAtRate() {
  std::error_code ignored;
  std::filesystem::remove(file_, ignored);
}

}  // namespace capstan::studies
