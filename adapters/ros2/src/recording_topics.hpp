// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "limpet/record/message_sink.hpp"

namespace limpet::ros {

/// Publishes what a recording holds, all but the scene, which the vehicle publishes itself. Its
/// messages are ROS 2's: ROS 1 has none of these.
/// @return null where it has no topics
[[nodiscard]] std::unique_ptr<record::MessageSink> recording_topics();

}  // namespace limpet::ros
