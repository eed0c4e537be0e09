// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros2/dds/node.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <set>
#include <utility>

#include "adapters/ros2/dds/discovery.hpp"
#include "adapters/ros2/dds/entities.hpp"

namespace limpet::ros2 {

using dds::Guid;

struct Node::Inside {
    explicit Inside(const NodeSettings& given) : settings(given), participant(given) {
        discovery_ = participant.write_to(kDiscoveryTopic, kDiscoveryType, kLatched);
        publish();
    }

    void add(const Guid& guid, bool is_reader) {
        const std::lock_guard lock(mutex_);
        (is_reader ? readers_ : writers_).insert(guid);
        publish();
    }
    void remove(const Guid& guid) {
        const std::lock_guard lock(mutex_);
        readers_.erase(guid);
        writers_.erase(guid);
        publish();
    }

    NodeSettings settings;
    dds::Participant participant;

private:
    void publish() {
        discovery_->write(
            settings.gid_bytes == 24
                ? discovery_bytes<24>(settings, participant.guid(), readers_, writers_)
                : discovery_bytes<16>(settings, participant.guid(), readers_, writers_),
            {});
    }

    std::mutex mutex_;
    std::set<Guid> readers_, writers_;
    std::unique_ptr<dds::DataWriter> discovery_;
};

namespace {

using dds::SampleId;

/// A reader or a writer that is listed as the node's as long as it is there.
template <class Entity>
class Listed {
public:
    Listed(std::shared_ptr<Node::Inside> inside, std::unique_ptr<Entity> entity, bool is_reader)
        : inside_(std::move(inside)), entity_(std::move(entity)) {
        inside_->add(entity_->guid(), is_reader);
    }
    ~Listed() { inside_->remove(entity_->guid()); }
    Listed(const Listed&) = delete;
    Listed& operator=(const Listed&) = delete;

    Entity* operator->() const { return entity_.get(); }

private:
    std::shared_ptr<Node::Inside> inside_;
    std::unique_ptr<Entity> entity_;
};
using ListedReader = Listed<dds::DataReader>;
using ListedWriter = Listed<dds::DataWriter>;

std::unique_ptr<ListedWriter> writer(const std::shared_ptr<Node::Inside>& inside,
                                     const std::string& topic, const std::string& type,
                                     const Profile& profile) {
    return std::make_unique<ListedWriter>(
        inside, inside->participant.write_to(topic, type, profile), false);
}
std::unique_ptr<ListedReader> reader(const std::shared_ptr<Node::Inside>& inside,
                                     const std::string& topic, const std::string& type,
                                     const Profile& profile, dds::Receive receive) {
    return std::make_unique<ListedReader>(
        inside, inside->participant.read_from(topic, type, profile, std::move(receive)), true);
}

class TopicWriter final : public Writer {
public:
    explicit TopicWriter(std::unique_ptr<ListedWriter> to) : to_(std::move(to)) {}
    void write(const Bytes& bytes) override { (*to_)->write(bytes, {}); }

private:
    std::unique_ptr<ListedWriter> to_;
};

// --- services -----------------------------------------------------------------------------------

/// What rmw_cyclonedds puts before a request, and again before its reply.
struct CycloneHeader {
    std::uint64_t client = 0;
    std::int64_t number = 0;
    template <class Self, class Visit>
    static void visit(Self& self, Visit&& each) {
        each(self.client);
        each(self.number);
    }
    friend bool operator==(const CycloneHeader&, const CycloneHeader&) = default;
};
constexpr std::size_t kCycloneHeader_bytes = 16;

Bytes with_header(const CycloneHeader& header, const Bytes& message) {
    Bytes bytes = encode(header);
    bytes.insert(bytes.end(), message.begin() + kEncapsulation_bytes, message.end());
    return bytes;
}
/// Takes it away.
std::optional<CycloneHeader> header_of(Bytes& bytes) {
    const auto header = decode<CycloneHeader>(bytes);
    if (!header || bytes.size() < kEncapsulation_bytes + kCycloneHeader_bytes) {
        return std::nullopt;
    }
    bytes.erase(bytes.begin() + kEncapsulation_bytes,
                bytes.begin() + kEncapsulation_bytes + kCycloneHeader_bytes);
    return header;
}

class Server {
public:
    Server(const std::shared_ptr<Node::Inside>& inside, const std::string& service,
           const std::string& request_type, const std::string& response_type,
           std::function<void(Bytes, Node::Reply)> serve)
        : way_(inside->settings.services),
          replies_(writer(inside, "rr" + service + "Reply", response_type, kServices)),
          serve_(std::move(serve)),
          requests_(reader(inside, "rq" + service + "Request", request_type, kServices,
                           [this](Bytes bytes, const dds::Sample& sample) {
                               receive(std::move(bytes), sample);
                           })) {}

private:
    void receive(Bytes bytes, const dds::Sample& sample) {
        if (way_ == ServiceWay::cyclone) {
            if (const auto header = header_of(bytes)) {
                serve_(std::move(bytes),
                       [replies = replies_, header = *header, asker = sample.id.guid,
                        since = Clock::now()](const Bytes& reply) {
                           (*replies)->wait_for_reader_beside(asker, patience_s(since));
                           (*replies)->write(with_header(header, reply), {});
                       });
            }
            return;
        }
        // A client is known by its writer, or by the reader of replies that it names.
        SampleId to = sample.id;
        const bool named = sample.related.guid != Guid{};
        if (named) {
            to.guid = sample.related.guid;
        }
        serve_(std::move(bytes),
               [replies = replies_, to, named, since = Clock::now()](const Bytes& reply) {
                   if (named) {  // it may have been found before our replies were
                       (*replies)->wait_for_reader(to.guid, patience_s(since));
                   }
                   (*replies)->write(reply, to);
               });
    }

    using Clock = std::chrono::steady_clock;

    /// A request may come before the reader of its reply is matched; half a second later it is, or
    /// the client has gone. rmw_fastrtps waits 0.1 s, which on a busy machine is too short.
    static double patience_s(Clock::time_point since) {
        constexpr double kMatch_s = 0.5;
        return std::max(0.0,
                        kMatch_s - std::chrono::duration<double>(Clock::now() - since).count());
    }

    ServiceWay way_;
    std::shared_ptr<ListedWriter> replies_;
    std::function<void(Bytes, Node::Reply)> serve_;
    std::unique_ptr<ListedReader> requests_;  ///< last: gone first
};

class ServiceClient final : public Client {
public:
    ServiceClient(const std::shared_ptr<Node::Inside>& inside, const std::string& service,
                  const std::string& request_type, const std::string& response_type)
        : way_(inside->settings.services),
          requests_(writer(inside, "rq" + service + "Request", request_type, kServices)),
          replies_(reader(inside, "rr" + service + "Reply", response_type, kServices,
                          [this](Bytes bytes, const dds::Sample& sample) {
                              receive(std::move(bytes), sample);
                          })) {
        const Guid guid = (*requests_)->guid();
        for (std::size_t i = 0; i < sizeof client_; ++i) {  // any number that is ours alone
            client_ = client_ * 256 + (guid[i + 8] ^ guid[i]);
        }
    }

    bool is_served() const override {
        return (*requests_)->readers() > 0 && (*replies_)->writers() > 0;
    }
    std::optional<Bytes> call(const Bytes& request, double patience_s) override {
        if (!is_served()) {
            return std::nullopt;
        }
        std::unique_lock lock(mutex_);
        answer_.reset();
        if (way_ == ServiceWay::cyclone) {
            asked_ = ++number_;
            (*requests_)->write(with_header({.client = client_, .number = asked_}, request), {});
        } else {
            asked_ = (*requests_)->write(request, {.guid = (*replies_)->guid()});
        }
        received_.wait_for(lock, std::chrono::duration<double>(patience_s),
                           [this] { return answer_.has_value(); });
        asked_ = 0;
        return std::exchange(answer_, std::nullopt);
    }

private:
    void receive(Bytes bytes, const dds::Sample& sample) {
        std::int64_t number = sample.related.number;
        bool ours = sample.related.guid == (*requests_)->guid() ||
                    sample.related.guid == (*replies_)->guid();
        if (way_ == ServiceWay::cyclone) {
            const auto header = header_of(bytes);
            ours = header && header->client == client_;
            number = header ? header->number : 0;
        }
        const std::lock_guard lock(mutex_);
        if (ours && number == asked_) {
            answer_ = std::move(bytes);
            received_.notify_all();
        }
    }

    ServiceWay way_;
    std::uint64_t client_ = 0;
    std::mutex mutex_;
    std::condition_variable received_;
    std::optional<Bytes> answer_;
    std::int64_t number_ = 0;
    std::int64_t asked_ = 0;  ///< number of the call that waits; 0: none
    std::unique_ptr<ListedWriter> requests_;
    std::unique_ptr<ListedReader> replies_;  ///< last: gone first
};

}  // namespace

Node::Node(const NodeSettings& settings) : inside_(std::make_shared<Inside>(settings)) {}
Node::~Node() = default;

const NodeSettings& Node::settings() const {
    return inside_->settings;
}

std::unique_ptr<Writer> Node::advertise(const std::string& topic, const std::string& type,
                                        const Profile& profile) {
    return std::make_unique<TopicWriter>(writer(inside_, "rt" + topic, type, profile));
}

Handle Node::subscribe(const std::string& topic, const std::string& type, const Profile& profile,
                       std::function<void(Bytes)> receive) {
    return reader(inside_, "rt" + topic, type, profile,
                  [receive = std::move(receive)](Bytes bytes, const dds::Sample&) {
                      receive(std::move(bytes));
                  });
}

Handle Node::serve(const std::string& service, const std::string& request_type,
                   const std::string& response_type, std::function<void(Bytes, Reply)> serve) {
    return std::make_shared<Server>(inside_, service, request_type, response_type,
                                    std::move(serve));
}

std::unique_ptr<Client> Node::client(const std::string& service, const std::string& request_type,
                                     const std::string& response_type) {
    return std::make_unique<ServiceClient>(inside_, service, request_type, response_type);
}

}  // namespace limpet::ros2
