// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <functional>
#include <string>

#include "adapters/ros2/dds/codec.hpp"

#if __has_include(<fastrtps/config.h>)
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <fastrtps/xmlparser/XMLProfileManager.h>
#else
#include <fastdds/LibrarySettings.hpp>
#include <fastdds/rtps/common/WriteParams.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.hpp>
#include <fastdds/utils/IPLocator.hpp>
#endif

// Fast DDS 2 (Debian 12) and Fast DDS 3 (Debian 13), where they name or shape a thing differently.
// Nobody else knows.
namespace limpet::ros2::dds {

namespace fast = eprosima::fastdds::dds;

/// Messages of any type, encapsulated: their bytes go through as they are.
struct AnyMessageBytes {
    static constexpr std::uint32_t kUsually_bytes = 512;  // more is got when it comes

    template <class Payload>
    static bool put(const void* data, Payload& payload) {
        const Bytes& bytes = *static_cast<const Bytes*>(data);
        if (bytes.size() > payload.max_size) {
            return false;
        }
        std::memcpy(payload.data, bytes.data(), bytes.size());
        payload.length = static_cast<std::uint32_t>(bytes.size());
        payload.encapsulation = bytes[1] == 0 ? CDR_BE : CDR_LE;
        return true;
    }
    template <class Payload>
    static bool take(const Payload& payload, void* data) {
        static_cast<Bytes*>(data)->assign(payload.data, payload.data + payload.length);
        return true;
    }
    static std::uint32_t size(const void* data) {
        return static_cast<std::uint32_t>(static_cast<const Bytes*>(data)->size());
    }
};

#if __has_include(<fastrtps/config.h>)

namespace rtps = eprosima::fastrtps::rtps;
constexpr auto kRead = eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK;

class AnyMessage final : public fast::TopicDataType {
public:
    explicit AnyMessage(const std::string& name) {
        setName(name.c_str());
        m_typeSize = AnyMessageBytes::kUsually_bytes;
        m_isGetKeyDefined = false;
        auto_fill_type_object(false);
        auto_fill_type_information(false);
    }
    bool serialize(void* data, rtps::SerializedPayload_t* payload) override {
        return AnyMessageBytes::put(data, *payload);
    }
    bool deserialize(rtps::SerializedPayload_t* payload, void* data) override {
        return AnyMessageBytes::take(*payload, data);
    }
    std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
        return [data] { return AnyMessageBytes::size(data); };
    }
    void* createData() override { return new Bytes; }
    void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
    bool getKey(void*, rtps::InstanceHandle_t*, bool) override { return false; }
};

inline void deliver_by_the_wire_alone(fast::DomainParticipantFactory&) {
    eprosima::fastrtps::LibrarySettingsAttributes library;
    library.intraprocess_delivery = eprosima::fastrtps::INTRAPROCESS_OFF;
    eprosima::fastrtps::xmlparser::XMLProfileManager::library_settings(library);
}

#else

namespace rtps = eprosima::fastdds::rtps;
constexpr auto kRead = fast::RETCODE_OK;

class AnyMessage final : public fast::TopicDataType {
public:
    explicit AnyMessage(const std::string& name) {
        set_name(name);
        max_serialized_type_size = AnyMessageBytes::kUsually_bytes;
        is_compute_key_provided = false;
    }
    bool serialize(const void* data, rtps::SerializedPayload_t& payload,
                   fast::DataRepresentationId_t) override {
        return AnyMessageBytes::put(data, payload);
    }
    bool deserialize(rtps::SerializedPayload_t& payload, void* data) override {
        return AnyMessageBytes::take(payload, data);
    }
    std::uint32_t calculate_serialized_size(const void* data,
                                            fast::DataRepresentationId_t) override {
        return AnyMessageBytes::size(data);
    }
    void* create_data() override { return new Bytes; }
    void delete_data(void* data) override { delete static_cast<Bytes*>(data); }
    bool compute_key(rtps::SerializedPayload_t&, rtps::InstanceHandle_t&, bool) override {
        return false;
    }
    bool compute_key(const void*, rtps::InstanceHandle_t&, bool) override { return false; }
};

inline void deliver_by_the_wire_alone(fast::DomainParticipantFactory& factory) {
    eprosima::fastdds::LibrarySettings library;
    library.intraprocess_delivery = eprosima::fastdds::INTRAPROCESS_OFF;
    factory.set_library_settings(library);
}

#endif

}  // namespace limpet::ros2::dds
