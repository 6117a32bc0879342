// SPDX-License-Identifier: Apache-2.0
#include "adapters/llrp/llrp_server.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <boost/asio.hpp>
#include <chrono>
#include <thread>

#include "tagfield/scenario/scenario_yaml.h"

namespace tagfield::llrp {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;

Scenario one_reader() {
  Diagnostics unheard;
  return scenario_from_text(
             "duration_s: 10\nmodel: link_budget\n"
             "antennas: [{name: gate, reader: gate, pose: [0, 0, 1], profiles: [speedway_r420, "
             "panel_6dbi]}]\n"
             "tags: [{id: t, position: [1, 0, 1]}]\n",
             "test", {}, nullptr, unheard)
      .scenario;
}

/// Whether the peer closes the connection within ten seconds.
bool is_ended(tcp::socket& socket) {
  using Clock = std::chrono::steady_clock;
  socket.non_blocking(true);
  std::array<char, 4096> bytes{};
  boost::system::error_code error;
  for (const auto begin = Clock::now(); Clock::now() - begin < std::chrono::seconds(10);) {
    socket.read_some(asio::buffer(bytes), error);
    if (error && error != asio::error::would_block) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

TEST(LlrpServer, EndsItsConnectionsWhereItGoes) {
  LiveOptions options;
  options.speed = 0.0;
  LiveWorld world(one_reader(), 1, {}, options);
  auto server = std::make_shared<LlrpServer>(LlrpOptions{"127.0.0.1", 0, 0, {}});
  server->open(world);
  asio::io_context io;
  tcp::socket client(io);
  client.connect({asio::ip::make_address("127.0.0.1"), server->addresses().front().port});
  // The world's thread accepts the client, which the reader then knows.
  std::atomic<bool> stop = false;
  std::thread running([&] { world.run(stop); });
  std::array<char, 1> first{};
  EXPECT_EQ(client.read_some(asio::buffer(first)), 1U);  // The connection event.
  stop = true;
  running.join();
  server.reset();
  EXPECT_TRUE(is_ended(client));
}

}  // namespace
}  // namespace tagfield::llrp
