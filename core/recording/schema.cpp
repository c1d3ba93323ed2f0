#include "core/recording/schema.h"

#include <fmt/format.h>

#include <array>

namespace capstan::recording {
namespace {

using enum ColumnType;

constexpr Column kSeq = {"seq", kInteger, "", "place in the order of arrival, across all tables"};
constexpr Column kTime = {"t", kReal, "s", "time of the measurement, session clock"};
constexpr Column kArrival = {"t_arrival", kReal, "s", "time of arrival at the computer, session clock"};

constexpr Column kMotor[] = {
    kSeq,
    kTime,
    {"q_m1", kReal, "rad", "motor 1 position from the hard stop"},
    {"q_m2", kReal, "rad", "motor 2 position from the hard stop"},
    {"q_m3", kReal, "rad", "motor 3 position from the hard stop"},
    {"dq_m1", kReal, "rad/s", "motor 1 velocity"},
    {"dq_m2", kReal, "rad/s", "motor 2 velocity"},
    {"dq_m3", kReal, "rad/s", "motor 3 velocity"},
    {"tau_m1", kReal, "N*m", "motor 1 torque command"},
    {"tau_m2", kReal, "N*m", "motor 2 torque command"},
    {"tau_m3", kReal, "N*m", "motor 3 torque command"},
};
constexpr Column kJoint[] = {
    kSeq,
    kTime,
    {"q1", kReal, "rad", "joint 1 encoder: the reference"},
    {"q2", kReal, "rad", "joint 2 encoder: the reference"},
    {"q3", kReal, "m", "joint 3 encoder: the reference"},
};
constexpr Column kTip[] = {
    kSeq,
    kTime,
    kArrival,
    {"p_c1", kReal, "m", "tip position from cameras, frame 0, x"},
    {"p_c2", kReal, "m", "tip position from cameras, frame 0, y"},
    {"p_c3", kReal, "m", "tip position from cameras, frame 0, z"},
};
constexpr Column kFrame[] = {
    kSeq,
    kTime,
    kArrival,
    {"codec", kInteger, "", "row of table codec"},
    {"width", kInteger, "px", "width of either image"},
    {"height", kInteger, "px", "height of either image"},
    {"left", kBlob, "", "left image, a packet of the codec; NULL: none"},
    {"right", kBlob, "", "right image, a packet of the codec; NULL: none"},
};
constexpr Column kEstimate[] = {
    kSeq,
    kTime,
    {"t_cam", kReal, "s", "exposure of the newest camera sample"},
    {"q_link_kin1", kReal, "rad", "joint 1 by transmission kinematics"},
    {"q_link_kin2", kReal, "rad", "joint 2 by transmission kinematics"},
    {"q_link_kin3", kReal, "m", "joint 3 by transmission kinematics"},
    {"q_link_cam1", kReal, "rad", "joint 1 from the cameras, at t_cam"},
    {"q_link_cam2", kReal, "rad", "joint 2 from the cameras, at t_cam"},
    {"q_link_cam3", kReal, "m", "joint 3 from the cameras, at t_cam"},
    {"q_link_cam_sigma1", kReal, "rad", "standard deviation of q_link_cam1"},
    {"q_link_cam_sigma2", kReal, "rad", "standard deviation of q_link_cam2"},
    {"q_link_cam_sigma3", kReal, "m", "standard deviation of q_link_cam3"},
    {"q_link_ukf1", kReal, "rad", "joint 1, filtered"},
    {"q_link_ukf2", kReal, "rad", "joint 2, filtered"},
    {"q_link_ukf3", kReal, "m", "joint 3, filtered"},
    {"dq_link_ukf1", kReal, "rad/s", "joint 1 velocity, filtered"},
    {"dq_link_ukf2", kReal, "rad/s", "joint 2 velocity, filtered"},
    {"dq_link_ukf3", kReal, "m/s", "joint 3 velocity, filtered"},
    {"q_link_ukf_sigma1", kReal, "rad", "standard deviation of q_link_ukf1"},
    {"q_link_ukf_sigma2", kReal, "rad", "standard deviation of q_link_ukf2"},
    {"q_link_ukf_sigma3", kReal, "m", "standard deviation of q_link_ukf3"},
    {"q_link_true1", kReal, "rad", "joint 1, newest reference"},
    {"q_link_true2", kReal, "rad", "joint 2, newest reference"},
    {"q_link_true3", kReal, "m", "joint 3, newest reference"},
    {"gate", kInteger, "", "0: the filter observes the cameras; else the reason why it observes kinematics"},
    {"camera_updated", kInteger, "", "1: this row took a camera sample"},
    {"nis", kReal, "1", "normalised innovation squared of the last update"},
    {"nees", kReal, "1", "normalised estimation error squared, where the truth is known"},
};
constexpr Column kEvent[] = {
    kSeq,
    kTime,
    {"kind", kText, "", "occlusion, registration, note, recorder"},
    {"text", kText, "", "what happened"},
};
constexpr Column kCodec[] = {
    {"id", kInteger, "", "key"},
    {"name", kText, "", "codec of libavcodec, planes G B R"},
    {"width", kInteger, "px", "width of the image; packets are padded to a multiple of four columns"},
    {"height", kInteger, "px", "height of the image"},
    {"fourcc", kInteger, "", "variant of the codec, four letters, the first in the lowest byte"},
    {"extradata", kBlob, "", "data that the decoder needs besides the packet"},
};
constexpr Column kHeader[] = {
    {"key", kText, "",
     "title, created, software, robot, camera_left, camera_right, truth, marker, tracking, "
     "registration, reference, rows"},
    {"value", kText, "", "text; contents of complete files"},
};
constexpr Column kDictionary[] = {
    {"table_name", kText, "", "table"},
    {"column_name", kText, "", "column; empty: the table itself"},
    {"unit", kText, "", "SI unit; empty: none"},
    {"meaning", kText, "", "meaning of the column"},
};

constexpr std::array kTables = {
    Table{"motor", "motor encoders and torque commands", kMotor},
    Table{"joint", "joint encoders: the reference, never an input of an estimator", kJoint},
    Table{"tip", "tip positions of another camera system", kTip},
    Table{"frame", "pairs of images", kFrame},
    Table{"estimate", "output of the tracking pipeline", kEstimate},
    Table{"event", "what happened", kEvent},
    Table{"codec", "codecs of the images", kCodec},
    Table{"header", "robot, cameras, registration, versions", kHeader},
    Table{"dictionary", "unit and meaning of every column", kDictionary},
};

std::string_view declaredType(ColumnType type) {
  switch (type) {
    case kReal:
      return "";
    case kInteger:
      return " INTEGER";
    case kText:
      return " TEXT";
    case kBlob:
      return " BLOB";
  }
  return "";
}

}  // namespace

std::span<const Table> tables() { return kTables; }
const Table& table(SampleTable which) { return kTables[which]; }
const Table& codecTable() { return kTables[kSampleTables]; }
const Table& headerTable() { return kTables[kSampleTables + 1]; }
const Table& dictionaryTable() { return kTables[kSampleTables + 2]; }
const Column kCheck = {kCheckColumn, ColumnType::kInteger, "", "CRC-32 of the row"};

std::string createStatement(const Table& table) {
  std::string sql = "CREATE TABLE " + std::string(table.name) + " (";
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const Column& column = table.columns[i];
    sql += std::string(i ? ", " : "") + std::string(column.name) + std::string(declaredType(column.type));
    if (i == 0 && table.name != "dictionary") sql += " PRIMARY KEY";
  }
  return sql + fmt::format(", {}{})", kCheckColumn, declaredType(ColumnType::kInteger));
}

std::string insertStatement(const Table& table, std::string_view verb) {
  std::string marks;
  for (std::size_t i = 1; i <= table.columns.size(); ++i) marks += fmt::format("?{}, ", i);
  const std::string values = marks.substr(0, marks.size() - 2);
  return fmt::format("{0} INTO {1} VALUES ({2}, row_crc('{1}', {2}))", verb, table.name, values);
}

std::string selectStatement(const Table& table, bool checked) {
  std::string names;
  for (const Column& column : table.columns)
    names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", column.name);
  const std::string holds =
      checked ? fmt::format(", row_holds({}, '{}', {})", kCheckColumn, table.name, names) : "";
  return fmt::format("SELECT {}{} FROM {}", names, holds, table.name);
}

}  // namespace capstan::recording
