#include "widgets/shell/estimate_publisher.h"

#include "widgets/shell/session_link.h"

namespace capstan::widgets {

EstimatePublisher::EstimatePublisher(SessionLink& link, const std::string& name_space, QObject* parent)
    : QObject(parent), topics_(name_space) {
  connect(&link, &SessionLink::opened, this,
          [this, &link](const tracking::SourceInfo& info) { link.listen(this, topics_.begin(info)); });
}

}  // namespace capstan::widgets
