// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "adapters/ros2/dds/node.hpp"

// What of DDS a node needs, of messages that are bytes: the only place that knows Fast DDS. Topics
// have their names of DDS here ("rt/clock").
namespace limpet::ros2::dds {

/// Of a participant, reader or writer, as RTPS has it: prefix, then the entity's id.
using Guid = std::array<std::uint8_t, 16>;

/// A sample, for all the world.
struct SampleId {
    Guid guid{};  ///< zeros: none
    std::int64_t number = 0;
};
struct Sample {
    SampleId id;
    SampleId related;  ///< the sample that it refers to
};
using Receive = std::function<void(Bytes, const Sample&)>;

class DataWriter {
public:
    virtual ~DataWriter() = default;
    /// @param related  goes along in the sample's header, unless it is none
    /// @return the sample's number
    virtual std::int64_t write(const Bytes& bytes, const SampleId& related) = 0;
    [[nodiscard]] virtual Guid guid() const = 0;
    [[nodiscard]] virtual int readers() const = 0;
    /// Until this reader is known here, or the time is over.
    virtual void wait_for_reader(const Guid& reader, double patience_s) = 0;
    /// Until one of the participant is that has `other`, a reader or writer.
    virtual void wait_for_reader_beside(const Guid& other, double patience_s) = 0;
};

class DataReader {
public:
    virtual ~DataReader() = default;
    [[nodiscard]] virtual Guid guid() const = 0;
    [[nodiscard]] virtual int writers() const = 0;
};

class Participant {
public:
    /// @throws InputError when DDS gives none
    explicit Participant(const NodeSettings& settings);

    [[nodiscard]] Guid guid() const;
    // They keep the participant.
    [[nodiscard]] std::unique_ptr<DataWriter> write_to(const std::string& topic,
                                                       const std::string& type,
                                                       const Profile& profile);
    [[nodiscard]] std::unique_ptr<DataReader> read_from(const std::string& topic,
                                                        const std::string& type,
                                                        const Profile& profile, Receive receive);

    struct Inside;

private:
    std::shared_ptr<Inside> inside_;
};

}  // namespace limpet::ros2::dds
