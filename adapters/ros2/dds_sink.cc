// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros2/dds_sink.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "adapters/ros2/dds_types.h"
#include "adapters/ros2/discovery.h"
#include "adapters/ros2/internal/libdds.h"
#include "adapters/ros2/ros2_topics.h"
#include "tagfield/base/error.h"

namespace tagfield::ros2 {
namespace {

constexpr dds_duration_t kMaxBlocking = DDS_SECS(1);
constexpr dds_duration_t kMaxWaitAtEnd = DDS_SECS(3);
constexpr std::uint32_t kLastDomain = 232;  // Domains above have no ports.
constexpr std::int32_t kDepth = 1000;       // Messages kept for slow readers of a reliable topic.

/// A DDS entity, deleted together with its children.
class Entity {
 public:
  Entity(dds_entity_t handle, const std::string& what) : handle_(handle) {
    if (handle < 0) throw Error(fmt::format("ROS 2: {}: {}", what, libdds().strretcode(-handle)));
  }
  ~Entity() {
    if (handle_ > 0) libdds().delete_(handle_);
  }
  Entity(Entity&& other) noexcept : handle_(std::exchange(other.handle_, 0)) {}
  Entity& operator=(Entity&& other) = delete;
  [[nodiscard]] dds_entity_t get() const { return handle_; }

 private:
  dds_entity_t handle_;
};

struct QosDeleter {
  void operator()(dds_qos_t* qos) const { libdds().delete_qos(qos); }
};
using Qos = std::unique_ptr<dds_qos_t, QosDeleter>;

Qos with_user_data(const std::string& text) {
  Qos qos(libdds().create_qos());
  libdds().qset_userdata(qos.get(), text.data(), text.size());
  return qos;
}

/// As in rmw: ROS 2 reads XCDR1 only.
Qos writer_qos(Delivery delivery, const std::string& type_hash) {
  Qos qos = with_user_data(fmt::format("typehash={};", type_hash));
  const dds_data_representation_id_t xcdr1 = DDS_DATA_REPRESENTATION_XCDR1;
  libdds().qset_data_representation(qos.get(), 1, &xcdr1);
  const bool keeps_one = delivery != Delivery::kReliable;
  libdds().qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, keeps_one ? 1 : kDepth);
  libdds().qset_reliability(
      qos.get(),
      delivery == Delivery::kBestEffort ? DDS_RELIABILITY_BEST_EFFORT : DDS_RELIABILITY_RELIABLE,
      kMaxBlocking);
  libdds().qset_durability(qos.get(), delivery == Delivery::kLatched
                                          ? DDS_DURABILITY_TRANSIENT_LOCAL
                                          : DDS_DURABILITY_VOLATILE);
  return qos;
}

rmw_dds_common::Gid gid_of(dds_entity_t entity) {
  dds_guid_t guid{};
  libdds().get_guid(entity, &guid);
  rmw_dds_common::Gid gid;
  std::copy(std::begin(guid.v), std::end(guid.v), gid.data.begin());
  return gid;
}

/// Captures the library's log messages during its lifetime, instead of standard error.
class Overheard {
 public:
  Overheard() { libdds().set_log_sink(&Overheard::hear, &text_); }
  ~Overheard() { libdds().set_log_sink(nullptr, nullptr); }
  Overheard(const Overheard&) = delete;
  Overheard& operator=(const Overheard&) = delete;
  /// The first line, or "".
  [[nodiscard]] std::string line() const { return text_.substr(0, text_.find('\n')); }

 private:
  static void hear(void* text, const dds_log_data_t* data) {
    static_cast<std::string*>(text)->append(data->message);
  }
  std::string text_;
};

/// A domain created by this process. It is deleted with its last participant, which may belong to
/// other code.
class Domain {
 public:
  Domain(std::uint32_t id, dds_entity_t handle) : id_(id), handle_(handle) {}
  ~Domain() {
    if (handle_ > 0 && libdds().lookup_participant(id_, nullptr, 0) == 0) libdds().delete_(handle_);
  }
  Domain(const Domain&) = delete;
  Domain& operator=(const Domain&) = delete;

 private:
  std::uint32_t id_;
  dds_entity_t handle_;  // Not positive if other code created it.
};

Error no_network(std::uint32_t domain, const Overheard& overheard) {
  return Error(fmt::format(
      "ROS 2: can't join domain {} ({}); CYCLONEDDS_URI says which network interface to use",
      domain, overheard.line()));
}

/// Creates a domain as configured by the environment. Cyclone's own CYCLONEDDS_URI takes precedence
/// over ROS 2's variables.
std::unique_ptr<Domain> set_up(std::uint32_t domain) {
  if (domain > kLastDomain) {
    throw Error(fmt::format("ROS 2: domain {}: expected 0 to {}", domain, kLastDomain));
  }
  std::string settings = cyclone_settings(discovery_of_environment());
  if (const char* const own = std::getenv("CYCLONEDDS_URI"))
    settings.append(settings.empty() ? "" : ",").append(own);
  const Overheard overheard;
  const dds_entity_t handle = libdds().create_domain(domain, settings.c_str());
  // A process has each domain once: earlier code has created it already.
  if (handle < 0 && handle != DDS_RETCODE_PRECONDITION_NOT_MET) throw no_network(domain, overheard);
  return std::make_unique<Domain>(domain, handle);
}

/// Creates a participant with the data that identify it as part of ROS 2.
Entity join(std::uint32_t domain) {
  const Overheard overheard;
  const dds_entity_t participant =
      libdds().create_participant(domain, with_user_data("enclave=/;").get(), nullptr);
  if (participant < 0) throw no_network(domain, overheard);
  return {participant, "participant"};
}

struct Reader {
  Entity topic;
  Entity reader;
};

/// Readers of velocities on a topic, for the types that are being published; before any is, for
/// Twist. `ros2 topic echo` and rosbag2 refuse topics with two types, so there are only readers for
/// types in use.
struct TwistReaders {
  std::string topic;  ///< "rt/cmd_vel"
  Entity publications;
  bool plain_seen = false;
  bool stamped_seen = false;
  std::optional<Reader> plain;
  std::optional<Reader> stamped;
};

constexpr std::string_view kPlainType = "geometry_msgs::msg::dds_::Twist_";
constexpr std::string_view kStampedType = "geometry_msgs::msg::dds_::TwistStamped_";

/// Checks for new publishers of the topic; returns whether there was one.
bool see_publishers(TwistReaders& twists) {
  constexpr std::size_t kMost = 16;
  bool seen = false;
  std::array<void*, kMost> samples{};
  std::array<dds_sample_info_t, kMost> infos{};
  const dds_return_t count =
      libdds().take(twists.publications.get(), samples.data(), infos.data(), kMost, kMost);
  for (std::size_t i = 0; i < static_cast<std::size_t>(std::max(count, 0)); ++i) {
    const auto* const found = static_cast<const dds_builtintopic_endpoint_t*>(samples.at(i));
    if (!infos.at(i).valid_data || twists.topic != found->topic_name) continue;
    twists.plain_seen = twists.plain_seen || kPlainType == found->type_name;
    twists.stamped_seen = twists.stamped_seen || kStampedType == found->type_name;
    seen = true;
  }
  if (count > 0) libdds().return_loan(twists.publications.get(), samples.data(), count);
  return seen;
}

/// Takes a message into a struct of the topic's type; false if there is no new one.
bool take_one(const std::optional<Reader>& reader, void* into) {
  if (!reader) return false;
  dds_sample_info_t info{};
  return libdds().take(reader->reader.get(), &into, &info, 1, 1) == 1 && info.valid_data;
}

geometry_msgs::Twist twist_of(const geometry_msgs_msg_dds__Twist_& twist) {
  return {{twist.linear.x, twist.linear.y, twist.linear.z},
          {twist.angular.x, twist.angular.y, twist.angular.z}};
}

struct Writer {
  Entity topic;
  Entity writer;
  DdsType type;
};

}  // namespace

const bool kHasDds = true;

struct DdsSink::Impl {
  Impl(std::uint32_t id, std::string name)
      : node_name(std::move(name)), domain(set_up(id)), participant(join(id)) {
    // Without the prefix of the nodes' topics.
    discovery.emplace(make_writer("ros_discovery_info", Delivery::kLatched,
                                  type_of(rmw_dds_common::ParticipantEntitiesInfo{})));
    tell_graph();
  }

  Writer make_writer(const std::string& topic, Delivery delivery, const Ros2Type& type) const {
    const DdsType& dds_type = dds_types().at(type.name);
    Entity made(libdds().create_topic(participant.get(), dds_type.descriptor, topic.c_str(),
                                      nullptr, nullptr),
                topic);
    Entity writer(libdds().create_writer(participant.get(), made.get(),
                                         writer_qos(delivery, type.hash).get(), nullptr),
                  topic);
    return {std::move(made), std::move(writer), dds_type};
  }

  /// Announces this as a node with its writers in the graph, as all nodes do.
  void tell_graph() {
    rmw_dds_common::NodeEntitiesInfo node;
    node.node_namespace = "/";
    node.node_name = node_name;
    for (const Writer& writer : writers) node.writer_gid_seq.push_back(gid_of(writer.writer.get()));
    for (const TwistReaders& twists : subscriptions) {
      for (const std::optional<Reader>* reader : {&twists.plain, &twists.stamped}) {
        if (*reader) node.reader_gid_seq.push_back(gid_of((*reader)->reader.get()));
      }
    }
    const rmw_dds_common::ParticipantEntitiesInfo info{gid_of(participant.get()), {node}};
    write(*discovery, &info);
  }

  Reader make_reader(const std::string& topic, const Ros2Type& type) const {
    Entity made(libdds().create_topic(participant.get(), dds_types().at(type.name).descriptor,
                                      topic.c_str(), nullptr, nullptr),
                topic);
    // Best-effort readers also receive from reliable writers, and only the newest command counts.
    const Qos qos = with_user_data(fmt::format("typehash={};", type.hash));
    libdds().qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, 1);
    libdds().qset_reliability(qos.get(), DDS_RELIABILITY_BEST_EFFORT, 0);
    Entity reader(libdds().create_reader(participant.get(), made.get(), qos.get(), nullptr), topic);
    return {std::move(made), std::move(reader)};
  }

  /// Creates readers of a topic's velocities for the types that were seen.
  void read_seen_types(TwistReaders& twists) {
    const bool wants_plain = twists.plain_seen || !twists.stamped_seen;
    if (wants_plain == twists.plain.has_value() &&
        twists.stamped_seen == twists.stamped.has_value()) {
      return;
    }
    if (!wants_plain) twists.plain.reset();
    if (wants_plain && !twists.plain) {
      twists.plain.emplace(make_reader(twists.topic, type_of(geometry_msgs::Twist{})));
    }
    if (twists.stamped_seen && !twists.stamped) {
      twists.stamped.emplace(make_reader(twists.topic, type_of(geometry_msgs::TwistStamped{})));
    }
    tell_graph();
  }

  static void write(const Writer& writer, const void* message) {
    writer.type.with_struct(message, [&](const void* data) {
      const dds_return_t result = libdds().write(writer.writer.get(), data);
      // A stalled reader must not stop the run: it loses messages once its queue is full.
      if (result < 0 && result != DDS_RETCODE_TIMEOUT) {
        throw Error(fmt::format("ROS 2: can't send: {}", libdds().strretcode(-result)));
      }
    });
  }

  std::string node_name;
  std::unique_ptr<Domain> domain;
  Entity participant;
  std::optional<Writer> discovery;
  std::vector<Writer> writers;
  std::vector<TwistReaders> subscriptions;
};

DdsSink::DdsSink(std::uint32_t domain, const std::string& node_name)
    : impl_(std::make_unique<Impl>(domain, node_name)) {}

DdsSink::~DdsSink() = default;

std::size_t DdsSink::advertise(const Ros2Topic& topic, const Ros2Type& type) {
  impl_->writers.push_back(impl_->make_writer("rt" + topic.name, topic.delivery, type));
  impl_->tell_graph();
  return impl_->writers.size() - 1;
}

void DdsSink::publish(std::size_t topic, Time /*stamp*/, const void* message) {
  Impl::write(impl_->writers.at(topic), message);
}

void DdsSink::finish() {
  const dds_time_t until = libdds().time() + kMaxWaitAtEnd;
  for (const Writer& writer : impl_->writers) {
    libdds().wait_for_acks(writer.writer.get(),
                           std::max<dds_duration_t>(until - libdds().time(), 0));
  }
}

std::size_t DdsSink::subscribe_twist(const std::string& topic) {
  Entity publications(libdds().create_reader(impl_->participant.get(),
                                             DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr),
                      "publications");
  impl_->subscriptions.push_back(
      {"rt" + topic, std::move(publications), false, false, std::nullopt, std::nullopt});
  impl_->read_seen_types(impl_->subscriptions.back());
  return impl_->subscriptions.size() - 1;
}

std::optional<geometry_msgs::Twist> DdsSink::take_twist(std::size_t subscription) {
  TwistReaders& twists = impl_->subscriptions.at(subscription);
  if (see_publishers(twists)) impl_->read_seen_types(twists);
  geometry_msgs_msg_dds__Twist_ plain{};
  if (take_one(twists.plain, &plain)) return twist_of(plain);
  geometry_msgs_msg_dds__TwistStamped_ stamped{};
  const bool came = take_one(twists.stamped, &stamped);
  const geometry_msgs::Twist twist = twist_of(stamped.twist);
  libdds().free(stamped.header.frame_id);
  return came ? std::optional(twist) : std::nullopt;
}

bool DdsSink::wait_for_reader(Duration most) const {
  const auto until = std::chrono::steady_clock::now() + most;
  do {
    for (const Writer& writer : impl_->writers) {
      dds_publication_matched_status_t matched{};
      libdds().get_publication_matched_status(writer.writer.get(), &matched);
      if (matched.current_count > 0) return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  } while (std::chrono::steady_clock::now() < until);
  return false;
}

}  // namespace tagfield::ros2
