// SPDX-License-Identifier: Apache-2.0
#include <arpa/inet.h>

#include <cstring>
#include <string>

#include "limpet/core/errors.hpp"
#include "limpet/devices/natnet.hpp"

namespace limpet::devices {
namespace {

constexpr std::string_view kName = "Limpet";
constexpr std::size_t kName_bytes = 256;
constexpr std::uint32_t kRigidBody_bytes = 38;

class Writer {
public:
    Writer(NatNetMessage kind, NatNetBuffer& into) : into_(into) {
        put(static_cast<std::uint16_t>(kind));
        put(std::uint16_t{0});  // the length, at the end
    }

    template <class T>
    void put(T value) {
        put_bytes(&value, sizeof(value));
    }
    void put_bytes(const void* bytes, std::size_t count) {
        require(length_ + count <= into_.size(), "a NatNet packet of ours fits its buffer");
        std::memcpy(into_.data() + length_, bytes, count);
        length_ += count;
    }
    void put_vector(const Vector3& v) {
        put(static_cast<float>(v.x()));
        put(static_cast<float>(v.y()));
        put(static_cast<float>(v.z()));
    }
    void put_name() {
        std::array<char, kName_bytes> name = {};
        kName.copy(name.data(), name.size());
        put_bytes(name.data(), name.size());
    }
    void put_version(NatNetVersion version) {
        put(version.major);
        put(version.minor);
        put(std::uint16_t{0});
    }

    std::span<const std::byte> packet() {
        const auto payload = static_cast<std::uint16_t>(length_ - 4);
        std::memcpy(into_.data() + 2, &payload, sizeof(payload));
        return std::span(into_).first(length_);
    }

private:
    NatNetBuffer& into_;
    std::size_t length_ = 0;
};

void put_empty_section(Writer& writer, NatNetVersion version) {
    writer.put(std::int32_t{0});
    if (has_section_sizes(version)) {
        writer.put(std::uint32_t{0});
    }
}

void put_bodies(Writer& writer, NatNetVersion version, const std::optional<NatNetBody>& body) {
    if (!body) {
        put_empty_section(writer, version);
        return;
    }
    writer.put(std::int32_t{1});
    if (has_section_sizes(version)) {
        writer.put(kRigidBody_bytes);
    }
    writer.put(body->id);
    writer.put_vector(body->pose.p_MP_m);
    writer.put_vector(body->pose.q_MP.vec());
    writer.put(static_cast<float>(body->pose.q_MP.w()));
    writer.put(static_cast<float>(body->mean_error_m));
    writer.put(static_cast<std::uint16_t>(body->tracking_valid ? 1 : 0));
}

}  // namespace

std::span<const std::byte> encode_connect(NatNetVersion version, NatNetBuffer& into) {
    Writer writer(NatNetMessage::connect, into);
    writer.put_name();
    writer.put_version(version);  // of the program
    writer.put_version(version);  // of the bit stream
    return writer.packet();
}

std::span<const std::byte> encode_keep_alive(NatNetBuffer& into) {
    return Writer(NatNetMessage::keep_alive, into).packet();
}

std::span<const std::byte> encode_server(const NatNetServer& server, NatNetBuffer& into) {
    Writer writer(NatNetMessage::server_info, into);
    writer.put_name();
    writer.put_version(server.version);
    writer.put_version(server.version);
    writer.put(server.clock_Hz);
    writer.put(server.data_port);
    writer.put(static_cast<std::uint8_t>(server.multicast ? 1 : 0));
    const in_addr_t group = inet_addr(std::string(kNatNetGroup).c_str());  // in network order
    writer.put_bytes(&group, sizeof(group));
    return writer.packet();
}

std::span<const std::byte> encode_frame(const NatNetFrame& frame, NatNetVersion version,
                                        NatNetBuffer& into) {
    Writer writer(NatNetMessage::frame_of_data, into);
    writer.put(frame.number);
    put_empty_section(writer, version);  // marker sets
    put_empty_section(writer, version);  // unlabelled markers
    put_bodies(writer, version, frame.body);
    const int others = has_section_sizes(version) ? 5 : 4;  // skeletons, assets (4.1), labelled
    for (int i = 0; i < others; ++i) {                      // markers, force plates, devices
        put_empty_section(writer, version);
    }
    writer.put(std::uint64_t{0});  // time code
    writer.put(frame.motive_time_s);
    writer.put(frame.mid_exposure_ticks);
    writer.put(frame.mid_exposure_ticks);  // received by the server
    writer.put(frame.transmit_ticks);
    if (has_section_sizes(version)) {
        writer.put(std::uint64_t{0});  // precision time
    }
    writer.put(static_cast<std::uint16_t>(frame.models_changed ? 2 : 0));
    writer.put(std::uint32_t{0});  // end of data
    return writer.packet();
}

}  // namespace limpet::devices
