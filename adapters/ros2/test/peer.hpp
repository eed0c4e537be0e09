// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dds/dds.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "limpet/core/errors.hpp"

namespace limpet::ros2 {

/// Waits for something, ten seconds at most.
template <class Condition>
[[nodiscard]] bool soon(Condition condition, double patience_s = 10.0) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(patience_s);
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end) {
            return false;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return true;
}

/// Another library's participant (Cyclone DDS), with types of its own making: on loopback alone,
/// without multicast, in the domain that the tests run in (ROS_DOMAIN_ID).
class Peer {
public:
    explicit Peer(int domain)
        : domain_(dds_create_domain(static_cast<dds_domainid_t>(domain), kLoopbackAlone)),
          participant_(
              dds_create_participant(static_cast<dds_domainid_t>(domain), nullptr, nullptr)) {
        require(domain_ > 0 && participant_ > 0, "Cyclone DDS gives a participant");
    }
    ~Peer() {
        dds_delete(participant_);
        dds_delete(domain_);
    }
    Peer(const Peer&) = delete;
    Peer& operator=(const Peer&) = delete;

    struct Manners {
        bool reliable = true;
        bool stays = false;  ///< transient local
    };
    dds_entity_t writer(const char* topic, const dds_topic_descriptor_t& type, Manners manners) {
        dds_qos_t* const qos = qos_of(manners);
        const dds_entity_t made =
            dds_create_writer(participant_, topic_of(topic, type), qos, nullptr);
        dds_delete_qos(qos);
        require(made > 0, "Cyclone DDS gives a writer");
        return made;
    }
    dds_entity_t reader(const char* topic, const dds_topic_descriptor_t& type, Manners manners) {
        dds_qos_t* const qos = qos_of(manners);
        const dds_entity_t made =
            dds_create_reader(participant_, topic_of(topic, type), qos, nullptr);
        dds_delete_qos(qos);
        require(made > 0, "Cyclone DDS gives a reader");
        return made;
    }
    /// @param builtin  DDS_BUILTIN_TOPIC_DCPSPUBLICATION or DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION
    [[nodiscard]] dds_entity_t discovers(dds_entity_t builtin) const {
        return dds_create_reader(participant_, builtin, nullptr, nullptr);
    }
    /// What it has discovered by itself, by its identifier.
    struct Endpoint {
        std::string topic, type, user_data;
    };
    using Endpoints = std::map<std::array<std::uint8_t, 16>, Endpoint>;
    static void discovered(dds_entity_t discovers, Endpoints& all) {
        take<dds_builtintopic_endpoint_t>(discovers, [&](const dds_builtintopic_endpoint_t& found) {
            std::array<std::uint8_t, 16> key{};
            std::copy_n(found.key.v, key.size(), key.begin());
            void* reported = nullptr;
            std::size_t size = 0;
            dds_qget_userdata(found.qos, &reported, &size);
            all[key] = {found.topic_name, found.type_name,
                        std::string(static_cast<const char*>(reported), size)};
            dds_free(reported);
        });
    }

    /// Calls each(const T&) for what has come.
    /// @return how many
    template <class T, class Each>
    static int take(dds_entity_t reader, Each each) {
        int count = 0;
        void* sample = nullptr;
        dds_sample_info_t info;
        while (dds_take(reader, &sample, &info, 1, 1) == 1) {
            if (info.valid_data) {
                each(*static_cast<const T*>(sample));
                ++count;
            }
            dds_return_loan(reader, &sample, 1);
            sample = nullptr;
        }
        return count;
    }
    static bool has_reader(dds_entity_t writer) {
        dds_publication_matched_status_t status;
        dds_get_publication_matched_status(writer, &status);
        return status.current_count > 0;
    }
    static bool has_writer(dds_entity_t reader) {
        dds_subscription_matched_status_t status;
        dds_get_subscription_matched_status(reader, &status);
        return status.current_count > 0;
    }

private:
    static constexpr const char* kLoopbackAlone =
        "<General><Interfaces><NetworkInterface address=\"127.0.0.1\"/></Interfaces>"
        "<AllowMulticast>false</AllowMulticast></General>"
        "<Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>31"
        "</MaxAutoParticipantIndex><Peers><Peer address=\"127.0.0.1\"/></Peers></Discovery>";

    static dds_qos_t* qos_of(Manners manners) {
        dds_qos_t* const qos = dds_create_qos();
        dds_qset_reliability(
            qos, manners.reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
            DDS_SECS(1));
        dds_qset_durability(
            qos, manners.stays ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
        dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 100);
        return qos;
    }
    dds_entity_t topic_of(const char* topic, const dds_topic_descriptor_t& type) const {
        return dds_create_topic(participant_, &type, topic, nullptr, nullptr);
    }

    dds_entity_t domain_;
    dds_entity_t participant_;
};

}  // namespace limpet::ros2
