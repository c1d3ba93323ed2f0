#pragma once

#include <QString>
#include <vector>

class QWidget;

namespace capstan::widgets {

/// A section of the manual: a page of resources/manual, and one of its headings (empty: the page's begin).
struct HelpTopic {
  QString page, section;
  bool operator==(const HelpTopic&) const = default;
};

/// Section about the panel that contains `widget`; the manual's begin for null and for widgets without one.
HelpTopic topicOf(const QWidget* widget);

/// Every topic, with the class of its widget.
const std::vector<std::pair<QString, HelpTopic>>& helpTopics();

}  // namespace capstan::widgets
