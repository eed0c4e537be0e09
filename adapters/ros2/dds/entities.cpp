// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros2/dds/entities.hpp"

#include <type_hashes.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <map>
#include <mutex>
#include <set>
#include <utility>

#include "adapters/ros2/dds/fast_dds.hpp"
#include "limpet/core/errors.hpp"

namespace limpet::ros2::dds {
namespace {

constexpr const char* kLoopback = "127.0.0.1";

Guid guid_of(const rtps::GUID_t& from) {
    Guid guid;
    std::copy_n(from.guidPrefix.value, rtps::GuidPrefix_t::size, guid.begin());
    std::copy_n(from.entityId.value, rtps::EntityId_t::size,
                guid.begin() + rtps::GuidPrefix_t::size);
    return guid;
}
rtps::GUID_t guid_from(const Guid& guid) {
    rtps::GUID_t to;
    std::copy_n(guid.begin(), rtps::GuidPrefix_t::size, to.guidPrefix.value);
    std::copy_n(guid.begin() + rtps::GuidPrefix_t::size, rtps::EntityId_t::size, to.entityId.value);
    return to;
}
SampleId id_of(const rtps::SampleIdentity& from) {
    return {guid_of(from.writer_guid()),
            static_cast<std::int64_t>(from.sequence_number().to64long())};
}

/// What readers and writers have in common.
template <class Qos>
void set(Qos& qos, const std::string& type, const Profile& profile) {
    // As every endpoint of ROS 2 since Iron: rmw_cyclonedds warns of each without.
    const auto* const hash = std::lower_bound(
        std::begin(kTypeHashes), std::end(kTypeHashes), type,
        [](const auto& row, const std::string& wanted) { return row.first < wanted; });
    if (hash != std::end(kTypeHashes) && hash->first == type) {
        const std::string hash_text = "typehash=" + std::string(hash->second) + ";";
        qos.user_data().assign(hash_text.begin(), hash_text.end());
    }
    qos.reliability().kind =
        profile.reliable ? fast::RELIABLE_RELIABILITY_QOS : fast::BEST_EFFORT_RELIABILITY_QOS;
    qos.durability().kind = profile.transient_local ? fast::TRANSIENT_LOCAL_DURABILITY_QOS
                                                    : fast::VOLATILE_DURABILITY_QOS;
    qos.history().kind = fast::KEEP_LAST_HISTORY_QOS;
    qos.history().depth = profile.depth;
    qos.resource_limits().max_samples = 0;  // none but the depth
    qos.resource_limits().max_samples_per_instance = 0;
    qos.resource_limits().allocated_samples = 1;
    qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    qos.data_sharing().off();
}

rtps::Locator_t locator(const std::string& address) {
    rtps::Locator_t locator;
    if (!rtps::IPLocator::setIPv4(locator, address)) {
        const auto found = rtps::IPLocator::resolveNameDNS(address).first;
        if (found.empty()) {
            throw InputError("ROS_STATIC_PEERS: " + address + " is nobody's name or address");
        }
        rtps::IPLocator::setIPv4(locator, *found.begin());
    }
    return locator;
}

fast::DomainParticipantQos participant_qos(const NodeSettings& settings) {
    fast::DomainParticipantQos qos = fast::PARTICIPANT_QOS_DEFAULT;
    qos.name(settings.full_name());
    const std::string enclave = "enclave=/;";  // by it a participant is one of ROS 2
    qos.user_data().assign(enclave.begin(), enclave.end());
    auto& builtin = qos.wire_protocol().builtin;
    builtin.readerHistoryMemoryPolicy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    builtin.writerHistoryMemoryPolicy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    if (settings.range != Range::off) {
        for (const std::string& peer : settings.peers) {
            builtin.initialPeersList.push_back(locator(peer));
        }
    }
    if (settings.range == Range::subnet) {
        if (!settings.peers.empty()) {
            builtin.initialPeersList.push_back(locator("239.255.0.1"));
        }
        return qos;
    }
    builtin.metatrafficUnicastLocatorList.push_back(rtps::Locator_t());  // hence no multicast
    auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
    constexpr std::uint32_t kMostNodes = 32;  // of this machine: ports that are tried
    udp->maxInitialPeersRange = kMostNodes;
    if (settings.peers.empty()) {
        udp->interfaceWhiteList = {kLoopback};
    }
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports.push_back(udp);
    if (settings.range == Range::off) {
        qos.allocation().participants.maximum = qos.allocation().participants.initial = 1;
        qos.allocation().participants.increment = 0;
    } else {
        builtin.initialPeersList.push_back(locator(kLoopback));
    }
    return qos;
}

}  // namespace

struct Participant::Inside {
    explicit Inside(const NodeSettings& settings) {
        // Two nodes of one process talk over the wire as any others: Fast DDS 2.9 locks itself up
        // when participants of one process find each other and deliver directly.
        deliver_by_the_wire_alone(*factory);
        participant = factory->create_participant(static_cast<std::uint32_t>(settings.domain),
                                                  participant_qos(settings));
        if (participant == nullptr) {
            throw InputError("DDS gives no participant in domain " +
                             std::to_string(settings.domain));
        }
        publisher = participant->create_publisher(fast::PUBLISHER_QOS_DEFAULT);
        subscriber = participant->create_subscriber(fast::SUBSCRIBER_QOS_DEFAULT);
    }
    ~Inside() {
        participant->delete_contained_entities();
        factory->delete_participant(participant);
    }
    Inside(const Inside&) = delete;
    Inside& operator=(const Inside&) = delete;

    /// One for all readers and writers of a topic.
    fast::Topic* topic(const std::string& name, const std::string& type) {
        const std::lock_guard lock(mutex_);
        fast::Topic*& topic = topics_[name];
        if (topic == nullptr) {
            fast::TypeSupport(new AnyMessage(type)).register_type(participant);
            topic = participant->create_topic(name, type, fast::TOPIC_QOS_DEFAULT);
            require(topic != nullptr, "a topic has one type in a node");
        }
        return topic;
    }

    std::shared_ptr<fast::DomainParticipantFactory> factory =
        fast::DomainParticipantFactory::get_shared_instance();
    fast::DomainParticipant* participant = nullptr;
    fast::Publisher* publisher = nullptr;
    fast::Subscriber* subscriber = nullptr;

private:
    std::mutex mutex_;
    std::map<std::string, fast::Topic*> topics_;
};

namespace {

class FastWriter final : public DataWriter, private fast::DataWriterListener {
public:
    FastWriter(std::shared_ptr<Participant::Inside> inside, fast::Topic* topic,
               const Profile& profile)
        : inside_(std::move(inside)) {
        fast::DataWriterQos qos = fast::DATAWRITER_QOS_DEFAULT;
        set(qos, topic->get_type_name(), profile);
        qos.publish_mode().kind = fast::SYNCHRONOUS_PUBLISH_MODE;
        writer_ = inside_->publisher->create_datawriter(topic, qos, this);
        require(writer_ != nullptr, "DDS gives a writer");
    }
    ~FastWriter() override {
        writer_->set_listener(nullptr);
        inside_->publisher->delete_datawriter(writer_);
    }
    FastWriter(const FastWriter&) = delete;
    FastWriter& operator=(const FastWriter&) = delete;

    std::int64_t write(const Bytes& bytes, const SampleId& related) override {
        rtps::WriteParams parameters;
        if (related.guid != Guid{}) {
            auto& id = parameters.related_sample_identity();
            id.writer_guid(guid_from(related.guid));
            if (related.number != 0) {
                id.sequence_number(
                    rtps::SequenceNumber_t(static_cast<std::uint64_t>(related.number)));
            }
        }
        writer_->write(const_cast<Bytes*>(&bytes), parameters);
        return id_of(parameters.sample_identity()).number;
    }
    Guid guid() const override { return guid_of(writer_->guid()); }
    int readers() const override {
        const std::lock_guard lock(mutex_);
        return static_cast<int>(readers_.size());
    }
    void wait_for_reader(const Guid& reader, double patience_s) override {
        wait(patience_s, [&] { return readers_.contains(reader); });
    }
    void wait_for_reader_beside(const Guid& other, double patience_s) override {
        constexpr std::ptrdiff_t kPrefix = 12;
        wait(patience_s, [&] {
            return std::any_of(readers_.begin(), readers_.end(), [&](const Guid& reader) {
                return std::equal(other.begin(), other.begin() + kPrefix, reader.begin());
            });
        });
    }

private:
    template <class Come>
    void wait(double patience_s, Come come) {
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, std::chrono::duration<double>(patience_s), come);
    }
    void on_publication_matched(fast::DataWriter*,
                                const fast::PublicationMatchedStatus& status) override {
        const Guid reader = guid_of(rtps::iHandle2GUID(status.last_subscription_handle));
        const std::lock_guard lock(mutex_);
        if (status.current_count_change > 0) {
            readers_.insert(reader);
        } else {
            readers_.erase(reader);
        }
        changed_.notify_all();
    }

    std::shared_ptr<Participant::Inside> inside_;
    fast::DataWriter* writer_ = nullptr;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::set<Guid> readers_;
};

class FastReader final : public DataReader, private fast::DataReaderListener {
public:
    FastReader(std::shared_ptr<Participant::Inside> inside, fast::Topic* topic,
               const Profile& profile, Receive receive)
        : inside_(std::move(inside)), receive_(std::move(receive)) {
        fast::DataReaderQos qos = fast::DATAREADER_QOS_DEFAULT;
        set(qos, topic->get_type_name(), profile);
        reader_ = inside_->subscriber->create_datareader(topic, qos, nullptr);
        require(reader_ != nullptr, "DDS gives a reader");
        reader_->set_listener(this);
        on_data_available(reader_);  // what came in between
    }
    ~FastReader() override {
        reader_->set_listener(nullptr);
        inside_->subscriber->delete_datareader(reader_);
    }
    FastReader(const FastReader&) = delete;
    FastReader& operator=(const FastReader&) = delete;

    Guid guid() const override { return guid_of(reader_->guid()); }
    int writers() const override {
        fast::SubscriptionMatchedStatus status;
        reader_->get_subscription_matched_status(status);
        return status.current_count;
    }

private:
    void on_data_available(fast::DataReader* reader) override {
        const std::lock_guard lock(mutex_);
        for (;;) {
            Bytes bytes;
            fast::SampleInfo info;
            if (reader->take_next_sample(&bytes, &info) != kRead) {
                return;
            }
            if (info.valid_data) {
                receive_(std::move(bytes),
                         {id_of(info.sample_identity), id_of(info.related_sample_identity)});
            }
        }
    }

    std::shared_ptr<Participant::Inside> inside_;
    Receive receive_;
    std::mutex mutex_;
    fast::DataReader* reader_ = nullptr;
};

}  // namespace

Participant::Participant(const NodeSettings& settings)
    : inside_(std::make_shared<Inside>(settings)) {}

Guid Participant::guid() const {
    return guid_of(inside_->participant->guid());
}

std::unique_ptr<DataWriter> Participant::write_to(const std::string& topic, const std::string& type,
                                                  const Profile& profile) {
    return std::make_unique<FastWriter>(inside_, inside_->topic(topic, type), profile);
}

std::unique_ptr<DataReader> Participant::read_from(const std::string& topic,
                                                   const std::string& type, const Profile& profile,
                                                   Receive receive) {
    return std::make_unique<FastReader>(inside_, inside_->topic(topic, type), profile,
                                        std::move(receive));
}

}  // namespace limpet::ros2::dds
