#pragma once

#include <memory>

#include "core/live/row_input.h"
#include "core/live/streams/row_parser.h"

namespace capstan::live {

/// Rows as text: a header line, then a line per row. A last row without line end is one of a file, and
/// excluded elsewhere.
class TextRows final : public RowInput {
 public:
  TextRows(std::unique_ptr<ByteStream> stream, RowParser parser)
      : stream_(std::move(stream)), parser_(std::move(parser)) {}

  std::string name() const override { return stream_->name(); }
  ReadState read(std::chrono::milliseconds wait) override {
    bytes_.clear();
    state_ = stream_->read(bytes_, wait);
    if (state_ == ReadState::kOpened || state_ == ReadState::kReplaced) parser_.restart();
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
  std::string bytes_;
  ReadState state_ = ReadState::kNothing;
  std::uint64_t incomplete_ = 0;
};

}  // namespace capstan::live
