#include "core/recording/estimate_rows.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "core/base/names.h"
#include "core/table_files/json_lines.h"

namespace capstan::recording {
namespace {

using Eigen::Vector3d;

const Vector3d kNone = Vector3d::Constant(std::nan(""));

/// Takes the cells of a row in the order of the columns.
class Row {
 public:
  explicit Row(RowFormat format) : json_(format == RowFormat::kJsonLines), text_(json_ ? "{" : "") {}

  void number(const char* name, double value) {
    const bool known = std::isfinite(value);
    begin(name, known);
    if (!known) return;
    if (json_)
      table_files::appendJsonNumber(text_, value);
    else
      text_ += fmt::format("{:.17g}", value);
  }
  void joints(const char* name, const Vector3d& values) {
    for (int i = 0; i < 3; ++i) number(fmt::format("{}{}", name, i + 1).c_str(), values(i));
  }
  void flag(const char* name, bool value) {
    begin(name, true);
    text_ += value ? '1' : '0';
  }
  void word(const char* name, std::string_view value) {
    begin(name, true);
    text_ += json_ ? fmt::format("\"{}\"", value) : std::string(value);
  }
  std::string line() { return text_ + (json_ ? "}\n" : "\n"); }

 private:
  void begin(const char* name, bool known) {
    if (!json_ && !first_) text_ += ',';
    if (json_ && known) text_ += fmt::format("{}\"{}\":", first_ ? "" : ",", name);
    first_ = first_ && json_ && !known;
  }

  bool json_, first_ = true;
  std::string text_;
};

constexpr const char* kColumns =
    "t,camera,t_cam,q_kin1,q_kin2,q_kin3,q_cam1,q_cam2,q_cam3,q_ukf1,q_ukf2,q_ukf3,dq_ukf1,dq_ukf2,dq_ukf3,"
    "sigma_ukf1,sigma_ukf2,sigma_ukf3,q1,q2,q3,gate,nis\n";

EstimateNumbers numbersOf(const tracking::Snapshot& s, const Vector3d& reference) {
  const bool camera = s.camera_updated;
  const double none = std::nan("");
  return {.t = s.t,
          .camera = camera,
          .t_cam = camera ? s.t_cam : none,
          .q_kin = s.q_link_kin,
          .q_cam = camera ? s.q_link_cam : kNone,
          .q_ukf = s.q_link_ukf,
          .dq_ukf = s.dq_link_ukf,
          .sigma_ukf = s.q_link_ukf_sigma,
          .q = reference,
          .gate = s.gate,
          .nis = camera ? s.nis : none};
}

std::string lineOf(RowFormat format, const EstimateNumbers& numbers) {
  Row row(format);
  row.number("t", numbers.t);
  row.flag("camera", numbers.camera);
  row.number("t_cam", numbers.t_cam);
  row.joints("q_kin", numbers.q_kin);
  row.joints("q_cam", numbers.q_cam);
  row.joints("q_ukf", numbers.q_ukf);
  row.joints("dq_ukf", numbers.dq_ukf);
  row.joints("sigma_ukf", numbers.sigma_ukf);
  row.joints("q", numbers.q);
  row.word("gate", base::nameOf(numbers.gate));
  row.number("nis", numbers.nis);
  return row.line();
}

}  // namespace

EstimateSequence::EstimateSequence(std::function<void(const EstimateNumbers&)> row) : row_(std::move(row)) {}

void EstimateSequence::add(const tracking::Sample& sample, const tracking::Snapshot& snapshot) {
  if (std::holds_alternative<tracking::MotorSample>(sample)) {
    flush();
    motor_row_ = numbersOf(snapshot, snapshot.reference_paired ? snapshot.q_link_true : kNone);
  } else if (std::holds_alternative<tracking::JointSample>(sample)) {
    if (snapshot.reference_paired && motor_row_) motor_row_->q = snapshot.q_link_true;
  } else {
    flush();
    row_(numbersOf(snapshot, snapshot.q_link_true_cam));
  }
}

void EstimateSequence::flush() {
  if (motor_row_) row_(*motor_row_);
  motor_row_.reset();
}

EstimateRows::EstimateRows(RowFormat format, std::function<void(const std::string&)> row)
    : format_(format), rows_([format, give = std::move(row)](const EstimateNumbers& numbers) {
        give(lineOf(format, numbers));
      }) {}

std::string EstimateRows::header() const { return format_ == RowFormat::kCsv ? kColumns : ""; }

}  // namespace capstan::recording
