#include "core/live/estimate_output.h"

#include "core/live/estimate_topics.h"
#include "core/live/tip_transforms.h"

namespace capstan::live {

EstimateOutputs::EstimateOutputs(const std::vector<std::string>& texts, const std::string& option) {
  for (const std::string& text : texts)
    if (isIgtlAddress(text))
      outputs_.push_back(std::make_unique<TipTransforms>(parseIgtlAddress(text, option)));
    else
      outputs_.push_back(std::make_unique<EstimateTopics>(text));
}

Listener EstimateOutputs::begin(const tracking::SourceInfo& info) {
  Listener all;
  for (const auto& output : outputs_) all = both(std::move(all), output->begin(info));
  return all;
}

std::vector<std::string> EstimateOutputs::addresses() const {
  std::vector<std::string> all;
  for (const auto& output : outputs_)
    if (std::string address = output->address(); !address.empty()) all.push_back(std::move(address));
  return all;
}

}  // namespace capstan::live
