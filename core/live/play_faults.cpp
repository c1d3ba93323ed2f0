#include "core/live/play_faults.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "core/base/error.h"

namespace capstan::live {
namespace {

using Kind = PlayFault::Kind;

struct Form {
  std::string_view name;
  Kind kind;
  bool amount, time;
  double most;  ///< largest amount
};
constexpr std::array kForms = {
    Form{"drop", Kind::kDrop, true, false, 1.0},       Form{"repeat", Kind::kRepeat, true, false, 1.0},
    Form{"jitter", Kind::kJitter, true, false, 10.0},  Form{"silence", Kind::kSilence, true, true, 3600.0},
    Form{"freeze", Kind::kFreeze, true, true, 3600.0}, Form{"step", Kind::kStep, true, true, 1e9},
    Form{"garbage", Kind::kGarbage, false, true, 1e9},
};

std::optional<double> numberOf(std::string_view text) {
  double value = 0.0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

}  // namespace

PlayFault parsePlayFault(const std::string& text, const std::string& option) {
  const auto refuse = [&](const std::string& reason) {
    throw base::InputError({"", 0, option, text, reason,
                            "Write drop:SHARE, repeat:SHARE, jitter:SECONDS, silence:SECONDS@TIME, "
                            "freeze:SECONDS@TIME, step:SECONDS@TIME or garbage@TIME"});
  };
  const std::size_t at = text.find('@'), colon = text.find(':');
  const std::string name = text.substr(0, std::min(at, colon));
  const auto form = std::ranges::find(kForms, std::string_view(name), &Form::name);
  if (form == kForms.end()) refuse("names no fault");
  if (form->amount != (colon != std::string::npos) || form->time != (at != std::string::npos) ||
      (form->amount && form->time && at < colon))
    refuse("has another form");
  PlayFault fault{.kind = form->kind};
  if (form->amount) {
    const auto amount =
        numberOf(std::string_view(text).substr(colon + 1, std::min(at, text.size()) - colon - 1));
    if (!amount || std::abs(*amount) > form->most || (*amount < 0.0 && form->kind != Kind::kStep))
      refuse("has an amount that is not possible");
    fault.amount = *amount;
  }
  if (form->time) {
    const auto time = numberOf(std::string_view(text).substr(at + 1));
    if (!time || *time < 0.0) refuse("has a time that is no number of seconds");
    fault.time = *time;
  }
  return fault;
}

std::optional<PlayedRow> FaultyRows::next(std::size_t row, double t, double begin) {
  PlayedRow played{.due = t - begin, .stamp = t, .row = row};
  const double now = t - begin;
  bool frozen = false, sent = true;
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (std::size_t k = 0; k < faults_.size(); ++k) {
    const PlayFault& fault = faults_[k];
    const bool during = now >= fault.time && now < fault.time + fault.amount;
    switch (fault.kind) {
      case Kind::kDrop:
        sent = sent && uniform(random_) >= fault.amount;
        break;
      case Kind::kRepeat:
        played.twice = played.twice || uniform(random_) < fault.amount;
        break;
      case Kind::kJitter:
        if (fault.amount > 0.0)
          played.due += std::exponential_distribution<double>(1.0 / fault.amount)(random_);
        break;
      case Kind::kSilence:
        sent = sent && !during;
        break;
      case Kind::kFreeze:
        frozen = frozen || during;
        break;
      case Kind::kStep:
        if (now >= fault.time) played.stamp += fault.amount;
        break;
      case Kind::kGarbage:
        if (now >= fault.time && !garbage_sent_[k]) garbage_sent_[k] = played.garbage = true;
        break;
    }
  }
  if (frozen && !frozen_) frozen_ = row;
  if (!frozen) frozen_.reset();
  if (frozen_) played.row = *frozen_;
  last_due_ = played.due = std::max(played.due, last_due_);
  if (!sent) return {};
  return played;
}

}  // namespace capstan::live
