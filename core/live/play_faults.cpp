#include "core/live/play_faults.h"

#include <fmt/ranges.h>

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
  bool rows, images;
};
constexpr std::array kForms = {
    Form{"drop", Kind::kDrop, true, false, 1.0, true, true},
    Form{"repeat", Kind::kRepeat, true, false, 1.0, true, false},
    Form{"jitter", Kind::kJitter, true, false, 10.0, true, true},
    Form{"silence", Kind::kSilence, true, true, 3600.0, true, true},
    Form{"freeze", Kind::kFreeze, true, true, 3600.0, true, true},
    Form{"step", Kind::kStep, true, true, 1e9, true, false},
    Form{"garbage", Kind::kGarbage, false, true, 1e9, true, false},
    Form{"swap", Kind::kSwap, true, true, 3600.0, false, true},
};

/// "drop:SHARE, repeat:SHARE, … or swap:SECONDS@TIME".
std::string formsOf(bool Form::*possible) {
  std::vector<std::string> all;
  for (const Form& form : kForms)
    if (form.*possible)
      all.push_back(std::string(form.name) + (form.amount ? form.most == 1.0 ? ":SHARE" : ":SECONDS" : "") +
                    (form.time ? "@TIME" : ""));
  const std::string last = std::move(all.back());
  all.pop_back();
  return fmt::format("{} or {}", fmt::join(all, ", "), last);
}

std::optional<double> numberOf(std::string_view text) {
  double value = 0.0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

PlayFault parse(const std::string& text, const std::string& option, bool Form::*possible) {
  const auto refuse = [&](const std::string& reason) {
    throw base::InputError({"", 0, option, text, reason, "Write " + formsOf(possible)});
  };
  const std::size_t at = text.find('@'), colon = text.find(':');
  const std::string name = text.substr(0, std::min(at, colon));
  const auto form = std::ranges::find(kForms, std::string_view(name), &Form::name);
  if (form == kForms.end() || !(form->*possible)) refuse("names no fault");
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

}  // namespace

PlayFault parseRowFault(const std::string& text, const std::string& option) {
  return parse(text, option, &Form::rows);
}

PlayFault parseImageFault(const std::string& text, const std::string& option) {
  return parse(text, option, &Form::images);
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
      case Kind::kSwap:
        played.swapped = played.swapped || during;
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
