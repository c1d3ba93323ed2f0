#include "widgets/shell/live_topics.h"

#include <QAbstractItemView>
#include <QComboBox>
#include <QLabel>
#include <QScrollBar>
#include <utility>

#include "core/ros1/bag_topics.h"
#include "core/ros1/master_topics.h"
#include "widgets/shell/address_box.h"

namespace capstan::widgets {
namespace {

constexpr int kPeriod = 3000;  // ms
constexpr std::chrono::milliseconds kPatience{700};
constexpr const char* kScheme = "ros:";

/// Replaces the topics in the list by those that fit. What is written in it stays, and so does the address
/// that was chosen from it, also where it is no longer published.
void fill(QComboBox& box, const std::vector<ros1::TopicType>& topics, bool (*fits)(const std::string&)) {
  const QString written = box.currentText();
  const bool chosen = box.findText(written) >= 0;
  const std::string value = valueOf(box);
  for (int k = box.count(); k-- > 0;)
    if (box.itemData(k).toString().startsWith(kScheme)) box.removeItem(k);
  for (const ros1::TopicType& one : topics)
    if (fits(one.type)) {
      const QString address = QString::fromStdString(kScheme + one.topic);
      box.addItem(QObject::tr("%1 — %2").arg(address, one.type.c_str()), address);
    }
  chosen ? setValue(box, value) : box.setEditText(written);
  // The list may be wider than its box: topics often differ only at their end.
  box.view()->setTextElideMode(Qt::ElideNone);
  box.view()->setMinimumWidth(box.view()->sizeHintForColumn(0) +
                              box.view()->verticalScrollBar()->sizeHint().width());
}

}  // namespace

LiveTopics::LiveTopics(QComboBox* motors, std::vector<QComboBox*> images, QObject* parent)
    : QObject(parent), motors_(motors), images_(std::move(images)), label_(new QLabel) {
  label_->setObjectName("ros_master");
  label_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);  // one line, however long the address
  label_->setToolTip(
      tr("Topics of a running ROS 1 system are listed in From, Left and Right. ROS_MASTER_URI "
         "names its master."));
  timer_.setInterval(kPeriod);
  connect(&timer_, &QTimer::timeout, this, &LiveTopics::ask);
}

void LiveTopics::setOn(bool on) {
  if (!on) return timer_.stop();
  timer_.start();
  ask();
}

void LiveTopics::ask() {
  if (job_.busy()) return;
  const std::string master = ros1::masterUri();
  job_.start([master](base::Progress&) { return ros1::topicsAtMaster(master, kPatience); },
             [this, master](Topics topics) { show(master, std::move(topics)); });
}

void LiveTopics::show(const std::string& master, Topics topics) {
  const QString at = QString::fromStdString(master);
  if (!topics) {
    label_->setText(tr("no ROS master at %1").arg(at));
    return;
  }
  label_->setText(topics->size() == 1 ? tr("1 topic at the ROS master %1").arg(at)
                                      : tr("%1 topics at the ROS master %2").arg(topics->size()).arg(at));
  topics_ = std::move(*topics);
  refill();
}

void LiveTopics::refill() {
  fill(*motors_, topics_, ros1::carriesMotors);
  for (QComboBox* box : images_) fill(*box, topics_, ros1::carriesImages);
}

}  // namespace capstan::widgets
