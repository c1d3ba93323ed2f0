#pragma once

#include <fmt/format.h>

#include <chrono>
#include <memory>

#include "core/live/row_input.h"
#include "core/live/streams/row_parser.h"

namespace capstan::live {

/// Rows as text: a header line, then a line per row. A last row without line end is one of a file, and
/// excluded elsewhere.
class TextRows final : public RowInput {
 public:
  static constexpr std::chrono::milliseconds kPatience{5000};

  /// `patience` with a program that is not there yet: then hint() says so.
  TextRows(std::unique_ptr<ByteStream> stream, RowParser parser,
           std::chrono::milliseconds patience = kPatience)
      : stream_(std::move(stream)), parser_(std::move(parser)), patience_(patience) {}

  std::string name() const override { return stream_->name(); }
  ReadState read(std::chrono::milliseconds wait) override {
    bytes_.clear();
    state_ = stream_->read(bytes_, wait);
    if (state_ == ReadState::kOpened || state_ == ReadState::kReplaced) parser_.restart();
    connected_ = connected_ || state_ == ReadState::kOpened || !bytes_.empty();
    parser_.add(bytes_);
    return state_;
  }
  std::optional<recording::MeasuredTable> take() override {
    const bool ended = state_ == ReadState::kEnded || state_ == ReadState::kClosed;
    if (ended && !stream_->isFile()) incomplete_ += parser_.discardIncomplete();
    auto rows = parser_.take(ended);
    if (state_ == ReadState::kClosed) parser_.restart();
    return rows;
  }
  /// Nobody has connected: the program may send to another address.
  std::optional<std::string> hint() override {
    const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - since_;
    if (connected_) return std::string();
    if (stream_->isFile() || waited < patience_) return {};
    return fmt::format("no program has connected to {} yet: start it, and check the address that it uses",
                       stream_->name());
  }
  void refuse(const std::string& reason) override {
    stream_->refuse(reason);
    parser_.restart();
  }
  void confirm() override { stream_->confirm(); }
  std::uint64_t incomplete() const override { return incomplete_; }
  void checkOrder(const recording::MeasuredTable& rows) override { parser_.checkOrder(rows); }

 private:
  std::unique_ptr<ByteStream> stream_;
  RowParser parser_;
  const std::chrono::milliseconds patience_;
  std::string bytes_;
  ReadState state_ = ReadState::kNothing;
  std::uint64_t incomplete_ = 0;
  const std::chrono::steady_clock::time_point since_ = std::chrono::steady_clock::now();
  bool connected_ = false;  ///< a program, so far
};

}  // namespace capstan::live
