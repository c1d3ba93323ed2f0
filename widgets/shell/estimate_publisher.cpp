#include "widgets/shell/estimate_publisher.h"

#include "widgets/shell/session_link.h"

namespace capstan::widgets {

EstimatePublisher::EstimatePublisher(SessionLink& link, const std::vector<std::string>& to, QObject* parent)
    : QObject(parent), outputs_(to, "--publish") {
  connect(&link, &SessionLink::opened, this,
          [this, &link](const tracking::SourceInfo& info) { link.listen(this, outputs_.begin(info)); });
}

}  // namespace capstan::widgets
