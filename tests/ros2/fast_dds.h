// SPDX-License-Identifier: Apache-2.0
/// @file
/// Fast DDS 2 and 3 as one: what the tests' programs ask of it and what the two call differently.
/// Which it is, CMake says by FAST_DDS.
#pragma once
#if FAST_DDS >= 3
#include <fastdds/rtps/participant/ParticipantDiscoveryInfo.hpp>
#include <fastdds/rtps/writer/WriterDiscoveryStatus.hpp>
#include <fastdds/utils/IPLocator.hpp>
#else
#include <fastdds/rtps/participant/ParticipantDiscoveryInfo.h>
#include <fastdds/rtps/writer/WriterDiscoveryInfo.h>
#include <fastrtps/utils/IPLocator.h>
#endif

#include <cstdint>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <functional>
#include <string>

namespace fast = eprosima::fastdds::dds;
#if FAST_DDS >= 3
namespace rtps = eprosima::fastdds::rtps;
inline const auto fast_ok = fast::RETCODE_OK;
#else
namespace rtps = eprosima::fastrtps::rtps;
inline const auto fast_ok = eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK;
#endif

/// A type without a key.
class FastType : public fast::TopicDataType {
 public:
  FastType(const std::string& name, std::uint32_t max_bytes) : max_bytes_(max_bytes) {
#if FAST_DDS >= 3
    set_name(name);
    max_serialized_type_size = max_bytes;
#else
    setName(name.c_str());
    m_typeSize = max_bytes;
    m_isGetKeyDefined = false;
#endif
  }

  /// False: can't be written, or can't be read.
  virtual bool write(const void* /*data*/, rtps::SerializedPayload_t& /*payload*/) { return false; }
  virtual bool read(const rtps::SerializedPayload_t& /*payload*/, void* /*data*/) { return false; }
  virtual void* create() = 0;
  virtual void destroy(void* data) = 0;

#if FAST_DDS >= 3
  bool serialize(const void* data, rtps::SerializedPayload_t& payload,
                 fast::DataRepresentationId_t /*representation*/) override {
    return write(data, payload);
  }
  bool deserialize(rtps::SerializedPayload_t& payload, void* data) override {
    return read(payload, data);
  }
  std::uint32_t calculate_serialized_size(
      const void* /*data*/, fast::DataRepresentationId_t /*representation*/) override {
    return max_bytes_;
  }
  void* create_data() override { return create(); }
  void delete_data(void* data) override { destroy(data); }
  bool compute_key(rtps::SerializedPayload_t& /*payload*/, rtps::InstanceHandle_t& /*handle*/,
                   bool /*force*/) override {
    return false;
  }
  bool compute_key(const void* /*data*/, rtps::InstanceHandle_t& /*handle*/,
                   bool /*force*/) override {
    return false;
  }
#else
  bool serialize(void* data, rtps::SerializedPayload_t* payload) override {
    return write(data, *payload);
  }
  bool deserialize(rtps::SerializedPayload_t* payload, void* data) override {
    return read(*payload, data);
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* /*data*/) override {
    return [bytes = max_bytes_] { return bytes; };
  }
  void* createData() override { return create(); }
  void deleteData(void* data) override { destroy(data); }
  bool getKey(void* /*data*/, rtps::InstanceHandle_t* /*handle*/, bool /*force*/) override {
    return false;
  }
#endif

 private:
  std::uint32_t max_bytes_;
};

/// Is notified of participants and writers that are found.
class FastDiscovery : public fast::DomainParticipantListener {
 public:
  virtual void found_participant(const std::string& user_data) = 0;
  virtual void found_writer(const std::string& topic, const std::string& type,
                            const std::string& user_data) = 0;

#if FAST_DDS >= 3
  void on_participant_discovery(fast::DomainParticipant* /*own*/,
                                rtps::ParticipantDiscoveryStatus status,
                                const fast::ParticipantBuiltinTopicData& info,
                                bool& /*ignored*/) override {
    if (status != rtps::ParticipantDiscoveryStatus::DISCOVERED_PARTICIPANT) return;
    found_participant(std::string(info.user_data.begin(), info.user_data.end()));
  }
  void on_data_writer_discovery(fast::DomainParticipant* /*own*/,
                                rtps::WriterDiscoveryStatus status,
                                const fast::PublicationBuiltinTopicData& info,
                                bool& /*ignored*/) override {
    if (status != rtps::WriterDiscoveryStatus::DISCOVERED_WRITER) return;
    found_writer(info.topic_name.to_string(), info.type_name.to_string(),
                 std::string(info.user_data.begin(), info.user_data.end()));
  }
#else
  void on_participant_discovery(fast::DomainParticipant* /*own*/,
                                rtps::ParticipantDiscoveryInfo&& info) override {
    if (info.status != rtps::ParticipantDiscoveryInfo::DISCOVERED_PARTICIPANT) return;
    const auto& data = info.info.m_userData;
    found_participant(std::string(data.begin(), data.end()));
  }
  void on_publisher_discovery(fast::DomainParticipant* /*own*/,
                              rtps::WriterDiscoveryInfo&& info) override {
    if (info.status != rtps::WriterDiscoveryInfo::DISCOVERED_WRITER) return;
    const auto& data = info.info.m_qos.m_userData;
    found_writer(info.info.topicName().to_string(), info.info.typeName().to_string(),
                 std::string(data.begin(), data.end()));
  }
#endif
};
