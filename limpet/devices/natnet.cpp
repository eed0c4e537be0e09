// SPDX-License-Identifier: Apache-2.0
#include "limpet/devices/natnet.hpp"

#include <arpa/inet.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "limpet/core/errors.hpp"

// Frame of data, in the order of the wire; "n" is a count (4 bytes), from 4.1 on followed by the
// section's length in bytes (4):
//
//   number, n marker sets, n unlabelled markers, n rigid bodies, n skeletons, n assets (4.1),
//   n labelled markers, n force plates, n devices, suffix
//
// Suffix: time code (4, 4), time (double), three clocks (8 each), in 4.1 perhaps a precision time
// (8), flags (2), end (4).

namespace limpet::devices {
namespace {

constexpr std::size_t kHeader_bytes = 4;
constexpr std::size_t kVector_bytes = 12;
constexpr std::uint32_t kRigidBody_bytes = 38;
constexpr std::size_t kMarker_bytes = 26;
constexpr std::size_t kSuffix_bytes = 42;  // without precision time and end
constexpr std::size_t kPrecisionTime_bytes = 8;
constexpr std::size_t kEnd_bytes = 4;
constexpr std::string_view kName = "Limpet";
constexpr std::size_t kName_bytes = 256;
constexpr double kQuaternionTolerance = 0.1;  // float noise is 1e-6; garbage is anywhere

/// From 4.1 on every section of a frame says how long it is.
bool has_section_sizes(NatNetVersion version) {
    return version.major == 4 && version.minor >= 1;
}

/// Reads on; once something is missing, all that follows is zero and `whole` false.
class Reader {
public:
    explicit Reader(std::span<const std::byte> bytes) : left_(bytes) {}

    template <class T>
    T take() {
        T value{};
        if (const auto* bytes = take_bytes(sizeof(T))) {
            std::memcpy(&value, bytes, sizeof(T));  // little-endian, as every host we build for
        }
        return value;
    }

    Vector3 take_vector() {
        const auto x = take<float>();
        const auto y = take<float>();
        const auto z = take<float>();
        return {x, y, z};
    }

    void skip(std::size_t bytes) { (void)take_bytes(bytes); }

    void skip_text() {
        const auto end = std::find(left_.begin(), left_.end(), std::byte{0});
        skip(static_cast<std::size_t>(end - left_.begin()) + 1);
    }

    /// A count that the bytes which are left can hold.
    /// @param size  of the smallest thing counted
    std::size_t take_count(std::size_t size) {
        const auto count = take<std::int32_t>();
        if (count < 0 || static_cast<std::size_t>(count) > left_.size() / size) {
            fail();
            return 0;
        }
        return static_cast<std::size_t>(count);
    }

    void fail() {
        left_ = {};
        whole_ = false;
    }
    [[nodiscard]] bool whole() const { return whole_; }
    [[nodiscard]] std::size_t left() const { return left_.size(); }

private:
    const std::byte* take_bytes(std::size_t count) {
        if (count > left_.size()) {
            fail();
            return nullptr;
        }
        const std::byte* bytes = left_.data();
        left_ = left_.subspan(count);
        return bytes;
    }

    std::span<const std::byte> left_;
    bool whole_ = true;
};

/// A section that nobody here wants.
/// @param size  of its smallest element
template <class SkipElement>
void skip_section(Reader& reader, NatNetVersion version, std::size_t size,
                  const SkipElement& skip_element) {
    if (has_section_sizes(version)) {
        (void)reader.take<std::int32_t>();
        reader.skip(reader.take<std::uint32_t>());
        return;
    }
    const std::size_t count = reader.take_count(size);
    for (std::size_t i = 0; i < count && reader.whole(); ++i) {
        skip_element();
    }
}

NatNetBody take_body(Reader& reader) {
    NatNetBody body;
    body.id = reader.take<std::int32_t>();
    body.pose.p_MP_m = reader.take_vector();
    const Vector3 xyz = reader.take_vector();
    body.pose.q_MP = Quaternion(reader.take<float>(), xyz.x(), xyz.y(), xyz.z());
    reader.skip(4);  // mean error of its markers
    body.tracking_valid = (reader.take<std::uint16_t>() & 1U) != 0;
    return body;
}

NatNetRefusal judge(const MocapPose& pose) {
    return !pose.p_MP_m.allFinite() || !pose.q_MP.coeffs().allFinite() ? NatNetRefusal::not_finite
           : std::abs(pose.q_MP.norm() - 1.0) < kQuaternionTolerance   ? NatNetRefusal::none
                                                                       : NatNetRefusal::no_attitude;
}

std::optional<NatNetBody> take_bodies(Reader& reader, NatNetVersion version, std::int32_t id,
                                      NatNetSeen& seen) {
    std::optional<NatNetBody> found;
    const std::size_t count = reader.take_count(kRigidBody_bytes);
    if (has_section_sizes(version) && reader.take<std::uint32_t>() != count * kRigidBody_bytes) {
        reader.fail();  // of a shape that we do not know
    }
    for (std::size_t i = 0; i < count && reader.whole(); ++i) {
        const NatNetBody body = take_body(reader);
        if (seen.bodies < seen.ids.size()) {
            seen.ids[seen.bodies] = body.id;
        }
        ++seen.bodies;
        if (body.id == id && !found) {
            found = body;
        }
    }
    return found;
}

void skip_to_suffix(Reader& reader, NatNetVersion version) {
    const auto channels = [&reader] {  // of a force plate or a device
        reader.skip(4);
        const std::size_t count = reader.take_count(4);
        for (std::size_t i = 0; i < count && reader.whole(); ++i) {
            reader.skip(4 * reader.take_count(4));
        }
    };
    skip_section(reader, version, 8, [&reader] {  // skeletons
        reader.skip(4);
        reader.skip(kRigidBody_bytes * reader.take_count(kRigidBody_bytes));
    });
    if (has_section_sizes(version)) {  // assets
        skip_section(reader, version, 1, [] {});
    }
    skip_section(reader, version, kMarker_bytes, [&reader] { reader.skip(kMarker_bytes); });
    skip_section(reader, version, 8, channels);  // force plates
    skip_section(reader, version, 8, channels);  // devices
}

void take_suffix(Reader& reader, NatNetVersion version, NatNetFrame& frame) {
    const bool precise =
        has_section_sizes(version) && reader.left() >= kSuffix_bytes + kPrecisionTime_bytes;
    reader.skip(8);
    frame.motive_time_s = reader.take<double>();
    frame.mid_exposure_ticks = reader.take<std::uint64_t>();
    reader.skip(8);
    frame.transmit_ticks = reader.take<std::uint64_t>();
    reader.skip((precise ? kPrecisionTime_bytes : 0) + 2);  // and flags
}

/// Whether what is left behind the suffix is the end mark that Motive sends, or nothing. From 4.1
/// on sections say their sizes, and a younger minor version may append to them.
bool ends_here(const Reader& reader, NatNetVersion version) {
    return has_section_sizes(version) || reader.left() == 0 || reader.left() == kEnd_bytes;
}

/// @return the payload of a packet of this kind
std::optional<Reader> payload(std::span<const std::byte> packet, NatNetMessage kind) {
    if (natnet_message(packet) != kind) {
        return std::nullopt;
    }
    Reader header(packet);
    header.skip(2);
    const auto length = header.take<std::uint16_t>();
    return Reader(packet.subspan(kHeader_bytes, length));
}

class Writer {
public:
    Writer(NatNetMessage kind, NatNetBuffer& into) : into_(into) {
        put(static_cast<std::uint16_t>(kind));
        put(std::uint16_t{0});  // the length, at the end
    }

    template <class T>
    void put(const T& value) {
        require(length_ + sizeof(T) <= into_.size(), "a NatNet packet of ours fits its buffer");
        std::memcpy(into_.data() + length_, &value, sizeof(T));
        length_ += sizeof(T);
    }
    void put_vector(const Vector3& v) {
        put(static_cast<float>(v.x()));
        put(static_cast<float>(v.y()));
        put(static_cast<float>(v.z()));
    }
    /// Name and version of the program, version of the bit stream.
    void put_sender(NatNetVersion version) {
        std::array<char, kName_bytes> name = {};
        kName.copy(name.data(), name.size());
        put(name);
        for (int i = 0; i < 2; ++i) {
            put(version.major);
            put(version.minor);
            put(std::uint16_t{0});
        }
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

/// Head of a section; by itself an empty one.
void put_section(Writer& writer, NatNetVersion version, std::int32_t count = 0,
                 std::uint32_t bytes = 0) {
    writer.put(count);
    if (has_section_sizes(version)) {
        writer.put(bytes);
    }
}

void put_bodies(Writer& writer, NatNetVersion version, const std::optional<NatNetBody>& body) {
    if (!body) {
        put_section(writer, version);
        return;
    }
    put_section(writer, version, 1, kRigidBody_bytes);
    writer.put(body->id);
    writer.put_vector(body->pose.p_MP_m);
    writer.put_vector(body->pose.q_MP.vec());
    writer.put(static_cast<float>(body->pose.q_MP.w()));
    writer.put(0.0F);  // mean error of its markers
    writer.put(static_cast<std::uint16_t>(body->tracking_valid ? 1 : 0));
}

}  // namespace

bool understood(NatNetVersion version) {
    return version.major == 3 || version.major == 4;
}

std::optional<NatNetMessage> natnet_message(std::span<const std::byte> packet) {
    Reader reader(packet);
    const auto id = reader.take<std::uint16_t>();
    const auto length = reader.take<std::uint16_t>();
    if (!reader.whole() || reader.left() < length) {
        return std::nullopt;
    }
    for (const NatNetMessage kind : {NatNetMessage::connect, NatNetMessage::server_info,
                                     NatNetMessage::frame_of_data, NatNetMessage::keep_alive}) {
        if (id == static_cast<std::uint16_t>(kind)) {
            return kind;
        }
    }
    return std::nullopt;
}

std::optional<NatNetFrame> decode_frame(std::span<const std::byte> packet, NatNetVersion version,
                                        std::int32_t body_id, NatNetSeen* seen) {
    NatNetSeen unwanted;
    NatNetSeen& found = seen != nullptr ? *seen : unwanted;
    found = {};
    const auto refuse = [&found](NatNetRefusal why) {
        found.refusal = why;
        return std::nullopt;
    };
    std::optional<Reader> reader = payload(packet, NatNetMessage::frame_of_data);
    if (!reader) {
        return refuse(NatNetRefusal::not_natnet);
    }
    if (!understood(version)) {
        return refuse(NatNetRefusal::version);
    }
    NatNetFrame frame;
    frame.number = reader->take<std::int32_t>();
    skip_section(*reader, version, 5, [&reader] {  // marker sets
        reader->skip_text();
        reader->skip(kVector_bytes * reader->take_count(kVector_bytes));
    });
    skip_section(*reader, version, kVector_bytes, [&reader] { reader->skip(kVector_bytes); });
    frame.body = take_bodies(*reader, version, body_id, found);
    skip_to_suffix(*reader, version);
    take_suffix(*reader, version, frame);
    if (!reader->whole() || !ends_here(*reader, version) || !std::isfinite(frame.motive_time_s)) {
        found = {};
        return refuse(NatNetRefusal::unreadable);
    }
    if (!frame.body) {
        found.refusal = NatNetRefusal::absent;
    } else if (const NatNetRefusal why = judge(frame.body->pose); frame.body->tracking_valid) {
        if (why != NatNetRefusal::none) {
            return refuse(why);
        }
    } else {
        found.refusal = NatNetRefusal::untracked;
        if (why != NatNetRefusal::none) {
            frame.body->pose = {};  // not seen yet: nothing is known
        }
    }
    return frame;
}

std::optional<NatNetServer> decode_server(std::span<const std::byte> packet) {
    std::optional<Reader> reader = payload(packet, NatNetMessage::server_info);
    if (!reader) {
        return std::nullopt;
    }
    NatNetServer server;
    reader->skip(kName_bytes + 4);  // name and version of the program
    server.version.major = reader->take<std::uint8_t>();
    server.version.minor = reader->take<std::uint8_t>();
    reader->skip(2);
    if (!reader->whole()) {
        return std::nullopt;
    }
    if (reader->left() >= 15) {  // 3.0 and later
        server.clock_Hz = reader->take<std::uint64_t>();
        server.data_port = reader->take<std::uint16_t>();
        server.multicast = reader->take<std::uint8_t>() != 0;
        server.group = reader->take<std::array<std::uint8_t, 4>>();
    }
    return server;
}

std::span<const std::byte> encode_connect(NatNetVersion version, NatNetBuffer& into) {
    Writer writer(NatNetMessage::connect, into);
    writer.put_sender(version);
    return writer.packet();
}

std::span<const std::byte> encode_keep_alive(NatNetBuffer& into) {
    return Writer(NatNetMessage::keep_alive, into).packet();
}

std::span<const std::byte> encode_server(const NatNetServer& server, NatNetBuffer& into) {
    Writer writer(NatNetMessage::server_info, into);
    writer.put_sender(server.version);
    writer.put(server.clock_Hz);
    writer.put(server.data_port);
    writer.put(static_cast<std::uint8_t>(server.multicast ? 1 : 0));
    writer.put(inet_addr(std::string(kNatNetGroup).c_str()));  // in network order
    return writer.packet();
}

std::span<const std::byte> encode_frame(const NatNetFrame& frame, NatNetVersion version,
                                        NatNetBuffer& into) {
    Writer writer(NatNetMessage::frame_of_data, into);
    writer.put(frame.number);
    put_section(writer, version);  // marker sets
    put_section(writer, version);  // unlabelled markers
    put_bodies(writer, version, frame.body);
    const int others = has_section_sizes(version) ? 5 : 4;  // skeletons, assets (4.1), labelled
    for (int i = 0; i < others; ++i) {                      // markers, force plates, devices
        put_section(writer, version);
    }
    writer.put(std::uint64_t{0});  // time code
    writer.put(frame.motive_time_s);
    writer.put(frame.mid_exposure_ticks);
    writer.put(frame.mid_exposure_ticks);  // received by the server
    writer.put(frame.transmit_ticks);
    if (has_section_sizes(version)) {
        writer.put(std::uint64_t{0});  // precision time
    }
    writer.put(std::uint16_t{0});  // flags
    writer.put(std::uint32_t{0});  // end of data
    return writer.packet();
}

}  // namespace limpet::devices
