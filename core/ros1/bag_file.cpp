#include "core/ros1/bag_file.h"

#include <fmt/format.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <set>

#include "core/base/error.h"
#include "core/ros1/stamp.h"

namespace capstan::ros1 {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& reason,
                         const std::string& remedy) {
  throw base::InputError({path.string(), 0, {}, {}, reason, remedy});
}

std::string reindex(const std::filesystem::path& path) {
  return fmt::format("Copy it again, or save the readable part with: rosbag reindex {}",
                     path.filename().string());
}

std::int64_t nanosecondsOf(const ros::Time& time) {
  return static_cast<std::int64_t>(time.sec) * kSecond + time.nsec;
}

void open(rosbag::Bag& bag, const std::filesystem::path& path) {
  std::error_code fault;
  if (!std::filesystem::is_regular_file(path, fault)) refuse(path, "is not a file", "Check the path");
  try {
    bag.open(path.string(), rosbag::bagmode::Read);
  } catch (const rosbag::BagUnindexedException&) {
    refuse(path, "has no index, because the program that recorded it was ended by force",
           fmt::format("Make one with: rosbag reindex {}", path.filename().string()));
  } catch (const std::exception& error) {
    refuse(path, fmt::format("is damaged or no bag of version 2.0: {}", error.what()), reindex(path));
  }
  if (bag.getMajorVersion() != 2)
    refuse(path, fmt::format("is a bag of version {}.{}", bag.getMajorVersion(), bag.getMinorVersion()),
           "Convert it with: rosbag fix");
}

}  // namespace

class BagFile::Impl {
 public:
  explicit Impl(const std::filesystem::path& path) : path_(path) {
    open(bag_, path);
    guarded([&] {
      view_.emplace(bag_);
      for (const rosbag::ConnectionInfo* one : view_->getConnections()) connections_.push_back(one);
      if (view_->size() > 0)
        begin_ = nanosecondsOf(view_->getBeginTime()), end_ = nanosecondsOf(view_->getEndTime());
      time_ = begin_;
    });
  }

  std::vector<TopicType> topics() const {
    std::vector<TopicType> found;
    std::set<std::string> known;
    for (const rosbag::ConnectionInfo* one : connections_)
      if (known.insert(one->topic).second) found.push_back({one->topic, one->datatype});
    return found;
  }
  std::string definitionOf(const std::string& topic) const {
    for (const rosbag::ConnectionInfo* one : connections_)
      if (one->topic == topic) return one->msg_def;
    return {};
  }
  std::int64_t begin() const { return begin_; }
  std::int64_t end() const { return end_; }

  void choose(const std::vector<std::string>& topics) {
    guarded([&] {
      view_.emplace(bag_, rosbag::TopicQuery(topics));
      next_ = view_->begin();
    });
  }

  std::optional<BagMessage> next() {
    std::optional<BagMessage> message;
    guarded([&] {
      if (next_ == view_->end()) return;
      const rosbag::MessageInstance& instance = *next_;
      time_ = nanosecondsOf(instance.getTime());
      message = BagMessage{time_, instance.getTopic(), instance.getDataType(), Bytes(instance.size())};
      ros::serialization::OStream stream(message->bytes.data(),
                                         static_cast<std::uint32_t>(message->bytes.size()));
      instance.write(stream);
      ++next_;
    });
    return message;
  }

 private:
  /// Does `work`; any fault of the library means that the file is damaged after the last message.
  template <class Work>
  void guarded(Work&& work) {
    try {
      work();
    } catch (const std::exception& error) {
      refuse(path_, fmt::format("is damaged {:.3f} s after its begin: {}", secondsOf(time_ - begin_), error.what()),
             reindex(path_));
    }
  }

  const std::filesystem::path path_;
  rosbag::Bag bag_;
  std::optional<rosbag::View> view_;
  std::vector<const rosbag::ConnectionInfo*> connections_;
  rosbag::View::iterator next_;
  std::int64_t begin_ = 0, end_ = 0, time_ = 0;
};

BagFile::BagFile(const std::filesystem::path& path) : impl_(std::make_unique<Impl>(path)) {}
BagFile::~BagFile() = default;
BagFile::BagFile(BagFile&&) noexcept = default;
std::vector<TopicType> BagFile::topics() const { return impl_->topics(); }
std::string BagFile::definitionOf(const std::string& topic) const { return impl_->definitionOf(topic); }
std::int64_t BagFile::begin() const { return impl_->begin(); }
std::int64_t BagFile::end() const { return impl_->end(); }
void BagFile::choose(const std::vector<std::string>& topics) { impl_->choose(topics); }
std::optional<BagMessage> BagFile::next() { return impl_->next(); }

}  // namespace capstan::ros1
