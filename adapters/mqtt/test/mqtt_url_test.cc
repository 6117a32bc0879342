// SPDX-License-Identifier: Apache-2.0
#include "adapters/mqtt/mqtt_url.h"

#include <gtest/gtest.h>

#include "tagfield/base/test/error_text.h"

namespace tagfield {
namespace {

TEST(MqttUrl, HasADefaultForAllButTheHost) {
  const MqttUrl url = mqtt_url("mqtt://broker");
  EXPECT_FALSE(url.has_tls);
  EXPECT_EQ(url.user, "");
  EXPECT_EQ(url.host, "broker");
  EXPECT_EQ(url.port, 1883);
  EXPECT_EQ(url.prefix, "tagfield");
  EXPECT_EQ(mqtt_url("mqtts://broker").port, 8883);
  EXPECT_TRUE(mqtt_url("mqtts://broker:1").has_tls);
}

TEST(MqttUrl, TakesAllParts) {
  const MqttUrl url = mqtt_url("mqtt://me%40home:p%3Aw@[::1]:5000/hall/7/");
  EXPECT_EQ(url.user, "me@home");
  EXPECT_EQ(url.password, "p:w");
  EXPECT_EQ(url.host, "::1");
  EXPECT_EQ(url.port, 5000);
  EXPECT_EQ(url.prefix, "hall/7");
  EXPECT_EQ(broker_name(url), "[::1]:5000");
  EXPECT_EQ(broker_name(mqtt_url("mqtt://user@host/")), "host:1883");
  EXPECT_EQ(mqtt_url("mqtt://host/a@b").prefix, "a@b");
}

TEST(MqttUrl, RefusesAllElseAndTellsNoPassword) {
  for (const char* text :
       {"", "broker", "http://broker", "mqtt://", "mqtt://:1883", "mqtt://h:0", "mqtt://h:65536",
        "mqtt://h:x", "mqtt://[::1", "mqtt://[::1]1", "mqtt://h/a+b", "mqtt://h/a%00", "mqtt://%@h",
        "mqtt://h/%zz", "mqtt://:secret@h"}) {
    const std::string message = error_of([&] { mqtt_url(text); });
    EXPECT_TRUE(contains(message, "must be mqtt://[user:password@]host")) << text;
    EXPECT_FALSE(contains(message, "secret")) << message;
  }
}

TEST(TopicLevel, HasNoWildcardsAndNoLevelsOfItsOwn) {
  EXPECT_EQ(topic_level("dock 3"), "dock 3");
  EXPECT_EQ(topic_level("a/b+c#d\n"), "a_b_c_d_");
}

TEST(ReaderTopics, AreWarnedOfIfChangedAndRefusedIfTheSame) {
  Diagnostics diagnostics;
  check_reader_topics({"", "dock 3", "dock/1", "dock_2"}, diagnostics);
  ASSERT_EQ(diagnostics.warnings().size(), 1U);
  EXPECT_TRUE(contains(diagnostics.warnings()[0], "reader 'dock/1' is …/reads/dock_1"));
  const std::string message = error_of([&] {
    check_reader_topics({"dock/1", "dock_1"}, diagnostics);
  });
  EXPECT_TRUE(contains(message, "readers 'dock/1' and 'dock_1' would have the same topic"));
}

}  // namespace
}  // namespace tagfield
