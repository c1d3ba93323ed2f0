#pragma once

#include "core/ros1/message_data.h"

namespace capstan::ros1 {

// For each message of message_data.h:

/// Facts about the type of message M.
template <class M>
const MessageType& typeOf();
/// Serialised message, as it is sent and stored in bags.
template <class M>
Bytes encode(const M& message);
/// Inverse of encode(), for messages that come from others: not for poses. Throws std::exception for bytes
/// that end too early.
template <class M>
M decode(const Bytes& bytes);

}  // namespace capstan::ros1
