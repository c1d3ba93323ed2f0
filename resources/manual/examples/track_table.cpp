// Core as a library: reads a measured table and writes joint estimates.
//   track_table ROBOT.yaml TABLE.csv ESTIMATES.csv
#include <cstdio>

#include "core/base/error.h"
#include "core/recording/table_source.h"
#include "core/robot/description.h"
#include "core/tracking/make_pipeline.h"
#include "core/tracking/track_all.h"

using namespace capstan;

int main(int count, char** arguments) {
  if (count != 4) return std::fputs("usage: track_table ROBOT.yaml TABLE.csv ESTIMATES.csv\n", stderr), 2;
  try {
    const auto source = recording::openRecording(arguments[2], robot::readDescription(arguments[1]));
    tracking::TrackingPipeline pipeline = tracking::makePipeline(source->info());

    std::FILE* out = std::fopen(arguments[3], "w");
    if (!out) return std::perror(arguments[3]), 2;
    std::fputs("t,q1,q2,q3,sigma1,sigma2,sigma3\n", out);  // s; rad, rad, m
    const auto report = tracking::trackAll(
        *source, pipeline, nullptr, 0.0, [&](const tracking::Sample& sample, const tracking::Snapshot& now) {
          if (!std::holds_alternative<tracking::MotorSample>(sample)) return;
          const auto& q = now.q_link_ukf;
          const auto& sigma = now.q_link_ukf_sigma;
          std::fprintf(out, "%.6f,%.9g,%.9g,%.9g,%.3g,%.3g,%.3g\n", now.t, q[0], q[1], q[2], sigma[0],
                       sigma[1], sigma[2]);
        });
    std::fclose(out);
    std::fputs(report.errors.text().c_str(), stdout);  // RMS errors, if the table has joint encoders
    return 0;
  } catch (const base::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());  // names place, value and remedy
    return 2;
  }
}
