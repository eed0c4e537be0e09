// SPDX-License-Identifier: Apache-2.0
#include "ros/src/recording_topics.hpp"

namespace limpet::ros {

std::unique_ptr<record::MessageSink> recording_topics() {
    return nullptr;
}

}  // namespace limpet::ros
